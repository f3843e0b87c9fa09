// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Buttons to look at what a filter has done, in the active view: its input in place of its result,
/// and the result in the colors of an array, with a legend:
///
///     <PropertyGroup label="Show" panel_widget="Look">
///       <Property name="Converged"/>
///       <Hints>
///         <Color text="Displacement" array="Displacement" property="GenerateDisplacement"/>
///         <Color text="Walls" array="WallThickness" none="not measured" scale="log"
///                least="MinimumThickness" note="..."/>
///         <Color text="Remaining Roundness" array="RemainingRoundness" of="Roundness"/>
///         <Turn property="PlaceOnPlate" axis="UpAxis"/>
///         <Plain array="STLSolidLabeling"/>
///         <Names array="PartId"/>
///       </Hints>
///     </PropertyGroup>
///
/// The property of the group is there for its place in the panel, see pqPresets.h. A button of
/// colors switches on the property that makes the array; a note is added to its tooltip. Numbers
/// that are shares of a property have a scale from 0 to that, or to the largest where that is more,
/// also when the property changes. With a least one that is wanted, the scale begins at that where
/// no number is less, so that what is well above it is not red. The result comes back, and the
/// model is hidden again, with a second click, with Apply, and where another filter or view is
/// chosen.
///
/// When the first Apply displays the result, ParaView colors it by the array that colors the model.
/// It then shows an array of colors as they are, where ParaView would map their magnitude, and the
/// surface in one color where the array is Plain: one that a reader made and no user asked for, or
/// that is done with, as numbers of parts once the parts are rounded.
/// The numbers of an array of Names get distinct colors. Where the first Apply fails, ParaView
/// would never color the result: it gets the colors of the model as soon as it is there. Where a
/// later one fails, ParaView would go on to show the result before it: it shows the next one.
///
/// Where what the view shows is over three times as large or small as what was there before, or
/// somewhere else, or grows by a tenth and around the camera, the camera is reset: so with a model
/// that Printable makes 80 mm high. Where the property of Turn is on, the filter turns the axis of
/// the model to z, the shortest way. The camera turns with it, and sees the same side as before.
#ifndef pqLook_h
#define pqLook_h

#include "pqColors.h"
#include "pqObservers.h"
#include "pqPropertyWidget.h"
#include "vtkBoundingBox.h"
#include "vtkWeakPointer.h"

#include <QPointer>
#include <QSet>

#include <utility>
#include <vector>

class QPushButton;
class pqPipelineSource;
class pqProxy;
class vtkSMPVRepresentationProxy;
class vtkSMPropertyGroup;
class vtkSMSourceProxy;

class pqLook : public pqPropertyWidget
{
  Q_OBJECT
  /// For tests: "model", "result, RGB itself, legend", "result, PartId of 9 names", "result,
  /// WallThickness log, legend".
  Q_PROPERTY(QString seen READ seen)
  /// For tests, of the color map of the result: "0 to 2".
  Q_PROPERTY(QString range READ range)
  /// For tests, of the view: "y up, from z".
  Q_PROPERTY(QString camera READ camera)

public:
  pqLook(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

  bool isSingleRowItem() const override;
  void apply() override;
  void select() override;
  void deselect() override;
  void setView(pqView* view) override;

  QString seen() const;
  QString range() const;
  QString camera() const;

private:
  struct Color
  {
    QByteArray Array;
    QByteArray None; // what the legend says where there is no number
    bool IsLogarithmic = false;
    vtkSmartPointer<vtkSMProperty> Whole;  // of which the numbers are shares
    vtkSmartPointer<vtkSMProperty> Least;  // where the scale begins, if it is above 0
    vtkSmartPointer<vtkSMProperty> Switch; // makes the array
    QPushButton* Button;
  };

  void addColor(vtkPVXMLElement* xml);
  void showModel(bool show);
  void showFirst(pqProxy* applied);
  void colorFirst(vtkSMPVRepresentationProxy* display);
  void colorAfterFailure();
  void noteExecution();
  void showAfterFailure();
  void fitColors();
  void colorBy(const Color& color, bool on);
  std::pair<double, double> rangeOf(const Color& color) const;
  void fitRange(const Color& color);
  int upOfResult() const;
  bool isElsewhere(const vtkBoundingBox& now) const;
  void frame(const vtkBoundingBox& now, int up);
  void noteDrawing();
  void refresh();
  void updateButtons();
  vtkSMPVRepresentationProxy* result() const;
  vtkSMPVRepresentationProxy* model() const; ///< the same for the model

  QPushButton* Before;
  std::vector<Color> Colors;
  pqColors::Choice OwnColors; // what the result had before a button colored it
  QSet<QByteArray> Plain;
  QSet<QByteArray> Names;
  bool FirstFailed = false;              // Apply
  bool Failed = false;                   // an execution since the result was shown
  vtkWeakPointer<vtkSMProxy> WithColors; // a display of colors as they are
  QMetaObject::Connection FirstApply;
  QPointer<pqPipelineSource> Source;
  vtkWeakPointer<vtkSMProxy> Shown;        // the model, in place of the result
  vtkWeakPointer<vtkSMProxy> Hidden;       // the result
  bool WasShown = false;                   // the model too
  vtkBoundingBox Framed;                   // what the view showed last
  int FramedUp = 2;                        // the axis of the model that was its z-axis
  vtkSmartPointer<vtkSMProperty> IsTurned; // whether the filter turns the model
  vtkSmartPointer<vtkSMProperty> Up;       // the axis that it turns to z
  std::pair<double, double> Fitted;        // the range of a color map that is kept
  bool IsColoring = false;                 // a button sets another array
  bool IsDrawn = true;                     // since the camera was reset
  pqObservers Observers;                   // of the result's display
  pqObservers FilterObservers;
};

#endif
