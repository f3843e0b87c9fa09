// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Few results of a filter that all others can be interpolated from. Private.
#ifndef vtkRoundnessTargets_h
#define vtkRoundnessTargets_h

#include "vtkSmartPointer.h" // for what is made

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;
class vtkSphericalStyleFilter;

namespace vtkRoundnessTargets
{
/// The slider: w = mu / (1 + mu) with mu = sqrt(3) Roundness, from 0 to 1.
double SliderOf(double roundness);
double RoundnessOf(double slider);

struct Options
{
  double MaximumRoundness = 5.0; ///< where the slider ends, unless the result is linear
  double Tolerance = 0.001;      ///< of the diagonal
  int MaximumNumber = 32;        ///< of targets
  bool MayRefine = true;         ///< the result may have more points
  bool WithNormals = true;
  std::function<void(double)> Progress; ///< share from 0 to 1
};

/// One vector per point; files have single precision, too.
using Vectors = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The vectors of an array, one per row; none without an array.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
Rows RowsOf(vtkDataArray* array);

/// What all points do at one place of the slider, against the model.
struct Target
{
  double Slider;
  Vectors Moves;
  Vectors Normals; ///< to be added, then normalized; no rows without normals
};

struct Targets
{
  vtkSmartPointer<vtkPolyData> Model; ///< that the moves start from, with its long edges split
  bool Linear = false;                ///< one target, at 1, is all results
  std::vector<Target> All;            ///< by ascending place
  /// Largest distances from results between the targets, as fractions of the diagonal: where the
  /// result changes steadily, and where it jumps.
  double Error = 0.0;
  double Jump = 0.0;
  std::vector<std::string> Warnings; ///< of the filter, one of those that differ in numbers
};

/// Solves at some places of the slider, in the middle between two of them until each result there
/// is near enough to what its neighbors give, and keeps as few as that takes. The filter is as
/// before in the end.
/// @throw std::runtime_error with the filter's message
Targets Make(vtkPolyData* model, vtkSphericalStyleFilter* style, const Options& options);
}

#endif
