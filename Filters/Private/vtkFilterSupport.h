// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the filters do alike and the solver knows nothing of. Private.
#ifndef vtkFilterSupport_h
#define vtkFilterSupport_h

#include "vtkSmartPointer.h" // for what is made
#include "vtkType.h"         // for vtkIdType

#include <array>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

class vtkAbstractArray;
class vtkAlgorithm;
class vtkDataObject;
class vtkFieldData;
class vtkInformation;
class vtkInformationVector;
class vtkTable;

namespace vtkFilterSupport
{
/// What the input ports of the filters hold.
enum InputPorts
{
  MODEL = 0,
  CENTERS = 1,    // vtkSphericalStyleFilter
  PROXY = 1,      // vtkConvexProxyDeformFilter
  REFERENCE = 1,  // vtkSurfaceMetrics
  STYLE_MESH = 1, // vtkNormalAnalogyFilter
  SURFACE = 1,    // vtkMeshMorphingFilter
  SELECTION = 2,
  REST_POSE = 3,
  TARGET = 4
};

/// @throw std::invalid_argument "name must be ...; it is value"
void Require(bool good, const char* name, const char* must, double value);

/// Center and radius where they are the user's own.
/// @param center, radius  nullptr when they are not @throw std::invalid_argument
void RequireSphere(const double* center, const double* radius);

/// Roundness, and center and radius where they are the user's own.
/// @param center, radius  nullptr when they are not @throw std::invalid_argument
void RequireTarget(double roundness, const double* center, const double* radius);

/// For constructors: from now on InBlock knows what the filter is running over.
void NoteBlocks(vtkAlgorithm* self);

/// "block \"Car/Wheel\": " while the filter runs over a block of composite data, else empty: how
/// its messages begin. A block without a name has its number, from 0, among its parent's.
std::string InBlock(vtkAlgorithm* self);

/// A warning of the filter, with InBlock before it; nothing for an empty text.
void Warn(vtkAlgorithm* self, const std::string& text);

/// The composite data that the filter runs over, with `surface` in the place of the block and
/// nothing elsewhere, so that what names blocks finds it; `surface` itself where there is none.
vtkSmartPointer<vtkDataObject> InTree(vtkAlgorithm* self, vtkDataObject* surface);

/// For FillInputPortInformation: any data set may come in, so that IsSurface can say what to do
/// with it.
void TakeDataSet(vtkInformation* port);

/// An error, with InBlock before it, and no output; no error for an empty text, where another
/// process tells.
void ReportFailure(vtkAlgorithm* self, vtkInformationVector* outputs, const char* what);

/// What the error says; of std::bad_alloc, whose own text is its name, "not enough memory".
const char* WordsOf(const std::exception& error);

/// What a filter said, without source file, line and address.
/// @param text  of vtkCommand::ErrorEvent or WarningEvent
std::string PlainMessage(const char* text);

/// For RequestData: runs `execute`. What it throws becomes an error message, and there is no output
/// then: no exception gets into the pipeline, which does not expect any.
/// @param forget  drops what is kept between executions: a failure that is not of the input, such
/// as
///        memory that ran out, may have left it unfinished
int RunGuarded(vtkAlgorithm* self, vtkInformationVector* outputs,
  const std::function<int()>& execute, const std::function<void()>& forget = {});

/// Whether the data at the port can be a surface, or there is none; else an error says how to get
/// one.
bool IsSurface(vtkAlgorithm* self, vtkInformationVector* port);

/// Adds an array of one number.
void AddCount(vtkFieldData* data, const char* name, int count);

/// Adds a column of that name.
void AddColumn(vtkTable* table, vtkAbstractArray* column, const char* name);

/// Adds the array StageSeconds, one component per stage.
void AddStageSeconds(vtkFieldData* data, const std::vector<std::pair<const char*, double>>& stages);

/// @param wanted  0: the number that vtkSMPTools::Initialize or LocalScope was given, or else
///        VTK_SMP_MAX_THREADS, or else all cores that this process may count as its own
int ThreadsToUse(int wanted);

/// Whether somebody asked the running filter to end. Asks the pipeline, so not from threads.
bool Aborted(vtkAlgorithm* self);

/// "1 triangle", "2 triangles"
std::string Count(vtkIdType n, const char* noun);

/// For PrintSelf.
const char* OnOff(bool on);
std::string Triple(const double* x);

/// An axis of the model, and the direction along it.
struct PlateAxis
{
  int Axis;
  double Sign;
};

/// What become x, y and z where a model is turned, the shortest way, so that z points up, as
/// programs for printers have it. Where y points up, what faces z then faces -y, their front.
std::array<PlateAxis, 3> PlateAxes(int upAxis);
}

#endif
