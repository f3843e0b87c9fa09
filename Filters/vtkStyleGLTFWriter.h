// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStyleGLTFWriter
 * @brief   write a model as glTF with a slider that rounds it
 *
 * Writes .glb and .gltf with the model as it is and morph targets: Blender shows them as shape
 * keys, game engines as blend shapes, browsers as morph targets. Their weights round the model as
 * far as wanted, without the filter.
 *
 * Input: vtkPolyData, the model. Its triangles are written (polygons and strips
 * are cut), its normals, or computed ones, texture coordinates, and colors: the active point
 * scalars of 3 or 4 components, bytes or numbers in 0..1, or else the first point array of 3 or 4
 * bytes. Axes and unit are those of the model, as VTK's writer does it. What the Style refines
 * (RefineLongEdges) is written refined.
 *
 * With SourceFileName there is no input: the targets are added to the meshes of that .glb or .gltf.
 * Everything that its scene shows is rounded as one model, skinned meshes in the pose that their
 * bones have there. Textures, materials, skins, other targets and animations stay as they are.
 *
 * The slider is w = mu / (1 + mu), mu = sqrt(3) Roundness, in 0..1. Without details and scaling
 * (DetailSize 0, KeepSize Off) the result is linear in w: there is one target, Roundness, with the
 * weight w. Else there are as many as Tolerance needs, at places of w that stand in the mesh's
 * extras: between two places the weight passes from one target to the next, as in the animation
 * Roundness, which moves the slider from 0 to MaximumRoundness.
 *
 * When the file is opened, the slider is at the Roundness of the Style. If the input is the result
 * of a filter that moves points (it has the point arrays Displacement and TargetDirection), the
 * slider is at 0, so that the file shows it as it looks, and a note says so: a WarningEvent where
 * somebody observes those of the writer, else text in the output window.
 *
 * Errors: no FileName, an ending other than .glb and .gltf, what the Style refuses, a source that
 * is not glTF 2.0, whose meshes are compressed or whose numbers lead out of it, or which refers to
 * files beside it while FileName is in another folder; a file that cannot be written.
 *
 * Cost: a first result of the Style, and up to 2 MaximumNumberOfTargets others, which take about a
 * tenth of that each; 12 bytes a point for each of them.
 *
 * @sa vtkSphericalStyleFilter vtkGLTFWriter
 */
#ifndef vtkStyleGLTFWriter_h
#define vtkStyleGLTFWriter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkSmartPointer.h"             // for the style
#include "vtkWriter.h"

class vtkPolyData;
class vtkSphericalStyleFilter;

class SPHERICALSTYLEFILTERS_EXPORT vtkStyleGLTFWriter : public vtkWriter
{
public:
  static vtkStyleGLTFWriter* New();
  vtkTypeMacro(vtkStyleGLTFWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write. It ends in .glb (one file) or .gltf (JSON, with the numbers in it as text).
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * A .glb or .gltf whose meshes get the targets, in a copy of it. Default nullptr: the input is
   * written.
   */
  vtkSetFilePathMacro(SourceFileName);
  vtkGetFilePathMacro(SourceFileName);
  ///@}

  ///@{
  /**
   * The filter with the properties to round with; it may have an input of its own. When the file is
   * written it has its input and properties of before, and its output when it is updated again.
   * Default: one with the defaults of the class.
   */
  void SetStyle(vtkSphericalStyleFilter* style);
  vtkSphericalStyleFilter* GetStyle();
  ///@}

  ///@{
  /**
   * Where the slider ends, unless one target is enough: that one reaches any Roundness. The Style's
   * own Roundness, if that is more. Range 0.01..1000. Default 5.
   */
  vtkSetRangeMacro(MaximumRoundness, double, 0.01, 1000.0);
  vtkGetMacro(MaximumRoundness, double);
  ///@}

  ///@{
  /**
   * How far a point may be from where the Style has it, between two targets, as a fraction of the
   * diagonal of the model's bounds. Where the result changes faster, it does so within 1/256 of the
   * slider instead. Range 0.00001..1. Default 0.001.
   */
  vtkSetRangeMacro(Tolerance, double, 0.00001, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * No more targets than this; the error may be larger then. Range 1..256. Default 32.
   */
  vtkSetRangeMacro(MaximumNumberOfTargets, int, 1, 256);
  vtkGetMacro(MaximumNumberOfTargets, int);
  ///@}

  ///@{
  /**
   * Facts of the last file: the number of targets; the largest distance from the Style's result
   * that was found between two of them, as a fraction of the diagonal, where the result changes
   * steadily, and where it changes faster (within 1/256 of the slider; 0 if nowhere); whether one
   * target is all results.
   */
  vtkGetMacro(NumberOfTargets, int);
  vtkGetMacro(LargestError, double);
  vtkGetMacro(LargestJump, double);
  vtkGetMacro(Linear, bool);
  ///@}

  /// @return 1, or 0 after an error.
  int Write() override;

protected:
  vtkStyleGLTFWriter();
  ~vtkStyleGLTFWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkStyleGLTFWriter(const vtkStyleGLTFWriter&) = delete;
  void operator=(const vtkStyleGLTFWriter&) = delete;

  /// @throw std::exception saying why there is no file
  void Execute(vtkPolyData* input);
  void Note(const char* text);

  char* FileName = nullptr;
  char* SourceFileName = nullptr;
  vtkSmartPointer<vtkSphericalStyleFilter> Style;
  double MaximumRoundness = 5.0;
  double Tolerance = 0.001;
  int MaximumNumberOfTargets = 32;
  int NumberOfTargets = 0;
  double LargestError = 0.0;
  double LargestJump = 0.0;
  bool Linear = false;
};

#endif
