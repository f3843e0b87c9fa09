// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRoundnessTargets.h"

#include "vtkFilterSupport.h"
#include "vtkSphericalStyleFilter.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <stdexcept>
#include <utility>

using vtkRoundnessTargets::Options;
using vtkRoundnessTargets::RoundnessOf;
using vtkRoundnessTargets::Rows;
using vtkRoundnessTargets::RowsOf;
using vtkRoundnessTargets::SliderOf;
using vtkRoundnessTargets::Target;
using vtkRoundnessTargets::Targets;
using vtkRoundnessTargets::Vectors;

namespace
{
/// The text without its numbers, and of things that are counted the singular: at other places of
/// the slider the filter warns of the same with other numbers.
std::string WithoutNumbers(const std::string& text)
{
  static const std::regex counted(R"([0-9]+ (\w+?)s?\b)");
  static const std::regex number(R"([0-9.]+)");
  return std::regex_replace(std::regex_replace(text, counted, "$1"), number, "");
}

/// Uses a filter of somebody else: what is changed is put back in the end.
class BorrowedFilter
{
public:
  BorrowedFilter(vtkSphericalStyleFilter* style, vtkPolyData* model, const Options& options)
    : Style(style)
    , Input(style->GetNumberOfInputConnections(0) > 0 ? style->GetInputConnection(0, 0) : nullptr)
    , Producer(this->Input ? this->Input->GetProducer() : nullptr)
    , Controller(style->GetController())
    , Roundness(style->GetRoundness())
    , Normals(style->GetGenerateNormals())
    , Precision(style->GetOutputPointsPrecision())
    , Refine(style->GetRefineLongEdges())
    , Preview(style->GetPreview())
  {
    this->Listener->SetClientData(this);
    this->Listener->SetCallback(&BorrowedFilter::Listen);
    this->Errors = style->AddObserver(vtkCommand::ErrorEvent, this->Listener);
    this->Warnings = style->AddObserver(vtkCommand::WarningEvent, this->Listener);
    // It says that the filter failed, where the filter has said why.
    this->Failures = style->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Listener);
    style->SetController(nullptr); // the model is all here
    style->PreviewOff();           // all points are asked for
    style->SetGenerateNormals(options.WithNormals);
    style->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    if (!options.MayRefine)
    {
      style->SetRefineLongEdgesToOff();
    }
    style->SetInputData(model);
  }

  ~BorrowedFilter()
  {
    this->Style->RemoveObserver(this->Errors);
    this->Style->RemoveObserver(this->Warnings);
    this->Style->GetExecutive()->RemoveObserver(this->Failures);
    this->Style->SetInputConnection(0, this->Input);
    this->Style->SetController(this->Controller);
    this->Style->SetRoundness(this->Roundness);
    this->Style->SetGenerateNormals(this->Normals);
    this->Style->SetOutputPointsPrecision(this->Precision);
    this->Style->SetRefineLongEdges(this->Refine);
    this->Style->SetPreview(this->Preview);
  }

  BorrowedFilter(const BorrowedFilter&) = delete;
  BorrowedFilter& operator=(const BorrowedFilter&) = delete;

  vtkPolyData* Execute(double roundness)
  {
    this->Style->SetRoundness(roundness);
    this->Style->Update();
    vtkPolyData* const output = this->Style->GetOutput();
    if (!this->Error.empty() || output->GetNumberOfPoints() == 0)
    {
      throw std::runtime_error(this->Error.empty() ? "the filter gave no result" : this->Error);
    }
    return output;
  }

  std::vector<std::string> Heard;

private:
  static void Listen(vtkObject*, unsigned long event, void* self, void* text)
  {
    auto* const filter = static_cast<BorrowedFilter*>(self);
    const std::string message = vtkFilterSupport::PlainMessage(static_cast<const char*>(text));
    if (event == vtkCommand::ErrorEvent)
    {
      filter->Error = filter->Error.empty() ? message : filter->Error;
    }
    else if (std::none_of(filter->Heard.begin(), filter->Heard.end(),
               [kind = WithoutNumbers(message)](const std::string& heard)
               { return WithoutNumbers(heard) == kind; }))
    {
      filter->Heard.push_back(message);
    }
  }

  vtkSmartPointer<vtkSphericalStyleFilter> Style;
  vtkSmartPointer<vtkAlgorithmOutput> Input;
  vtkSmartPointer<vtkAlgorithm> Producer; // nothing else may keep it
  vtkSmartPointer<vtkMultiProcessController> Controller;
  double Roundness;
  bool Normals;
  int Precision;
  int Refine;
  bool Preview;
  vtkNew<vtkCallbackCommand> Listener;
  unsigned long Errors = 0;
  unsigned long Warnings = 0;
  unsigned long Failures = 0;
  std::string Error;
};

Rows PlacesOf(vtkPolyData* surface)
{
  return RowsOf(surface->GetPoints()->GetData());
}

Rows NormalsOf(vtkPolyData* surface)
{
  return RowsOf(surface->GetPointData()->GetNormals());
}

/// The results at places of the slider, each computed once.
class Results
{
public:
  Results(vtkPolyData* model, vtkSphericalStyleFilter* style, const Options& options)
    : Filter(style, model, options)
    , WithNormals(options.WithNormals)
    , Progress(options.Progress)
  {
    this->Model->ShallowCopy(this->Filter.Execute(0.0));
    this->Places = PlacesOf(this->Model);
    this->Known.emplace(0.0, Vectors::Zero(this->Places.rows(), 3));
    double bounds[6];
    this->Model->GetBounds(bounds);
    this->Diagonal =
      std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
    this->Diagonal = this->Diagonal > 0.0 ? this->Diagonal : 1.0;
  }

  /// How far the points are from the model.
  const Vectors& MovesAt(double slider)
  {
    const auto found = this->Known.find(slider);
    if (found != this->Known.end())
    {
      return found->second;
    }
    vtkPolyData* const result = this->Filter.Execute(RoundnessOf(slider));
    if (result->GetNumberOfPoints() != this->Model->GetNumberOfPoints())
    {
      throw std::runtime_error("the results have different numbers of points");
    }
    if (this->Progress)
    {
      const auto count = static_cast<double>(this->Known.size());
      this->Progress(count / (count + 10.0)); // it is not known how many there will be
    }
    return this->Known.emplace(slider, (PlacesOf(result) - this->Places).cast<float>())
      .first->second;
  }

  /// Against those of the model. Not kept, since few are needed.
  Vectors NormalsAt(double slider)
  {
    if (!this->WithNormals)
    {
      return {};
    }
    const Rows after = NormalsOf(this->Filter.Execute(RoundnessOf(slider)));
    return (after - NormalsOf(this->Model)).cast<float>();
  }

  /// Largest distance between the result at a place and the line through two others, as a fraction
  /// of the diagonal.
  double Distance(double from, double slider, double to)
  {
    const auto share = static_cast<float>((slider - from) / (to - from));
    const Vectors& a = this->MovesAt(from);
    const Vectors& b = this->MovesAt(to);
    const Vectors& c = this->MovesAt(slider);
    const float squared = (a + share * (b - a) - c).rowwise().squaredNorm().maxCoeff();
    return std::sqrt(static_cast<double>(squared)) / this->Diagonal;
  }

  /// All that were computed, ascending.
  std::vector<double> Computed() const
  {
    std::vector<double> sliders;
    for (const auto& [slider, moves] : this->Known)
    {
      sliders.push_back(slider);
    }
    return sliders;
  }

  vtkNew<vtkPolyData> Model;
  BorrowedFilter Filter;

private:
  bool WithNormals;
  std::function<void(double)> Progress;
  Rows Places;
  double Diagonal = 1.0;
  std::map<double, Vectors> Known;
};

/// Whether the results lie on lines: a straight one through the model and one result has the others
/// on it. If so there is one target, at the end of all lines.
bool AddLine(Results& results, Targets& targets)
{
  constexpr double from = 0.5;
  constexpr double tried[] = { 0.25, 0.8 };
  constexpr double same = 2e-7; // single precision
  if (results.Distance(0.0, tried[0], from) > same || results.Distance(0.0, tried[1], from) > same)
  {
    return false;
  }
  // Normals turn, so that one line only fits them by the least squares.
  Target target{ 1.0, results.MovesAt(from) / static_cast<float>(from), {} };
  target.Normals = results.NormalsAt(from) * static_cast<float>(from);
  double squares = from * from;
  for (const double slider : tried)
  {
    target.Normals += results.NormalsAt(slider) * static_cast<float>(slider);
    squares += slider * slider;
  }
  target.Normals /= static_cast<float>(squares);
  targets.Linear = true;
  targets.All.push_back(std::move(target));
  return true;
}

/// Splits the part of the slider with the largest error in its middle, until none is too large.
/// Begins with even parts, for a bend to one side and the other has no error in its middle. At a
/// jump that would not end: parts below the least width are left as they are.
/// @return the middles of such parts
std::vector<double> Sample(Results& results, double end, double tolerance, std::size_t most)
{
  constexpr double leastWidth = 1.0 / 256;
  constexpr int firstParts = 8;
  struct Part
  {
    double From, To, Error;
    double Middle() const { return (this->From + this->To) / 2.0; }
  };
  const auto part = [&](double from, double to) {
    return Part{ from, to, results.Distance(from, (from + to) / 2.0, to) };
  };
  std::vector<Part> open;
  open.reserve(firstParts);
  for (int k = 0; k < firstParts; ++k)
  {
    open.push_back(part(end * k / firstParts, end * (k + 1) / firstParts));
  }
  std::vector<double> jumps;
  while (!open.empty() && results.Computed().size() + 2 <= most)
  {
    const auto worst = std::max_element(
      open.begin(), open.end(), [](const Part& a, const Part& b) { return a.Error < b.Error; });
    const Part wide = *worst;
    open.erase(worst);
    if (!(wide.Error > tolerance))
    {
      break; // and so are all others
    }
    if (wide.To - wide.From < 2.0 * leastWidth)
    {
      jumps.push_back(wide.Middle());
      continue;
    }
    open.push_back(part(wide.From, wide.Middle()));
    open.push_back(part(wide.Middle(), wide.To));
  }
  return jumps;
}

/// From each target on the next as far away as possible: the results between are near the line.
/// @param error  becomes the largest distance
std::vector<double> Fewest(
  Results& results, const std::vector<double>& sliders, double tolerance, double& error)
{
  std::vector<double> chosen = { sliders.front() };
  error = 0.0;
  for (std::size_t from = 0; from + 1 < sliders.size();)
  {
    std::size_t to = from + 1;
    double own = 0.0;
    for (std::size_t next = to + 1; next < sliders.size(); ++next)
    {
      double largest = 0.0;
      for (std::size_t k = from + 1; k < next && !(largest > tolerance); ++k)
      {
        largest = std::max(largest, results.Distance(sliders[from], sliders[k], sliders[next]));
      }
      if (largest > tolerance)
      {
        break;
      }
      to = next;
      own = largest;
    }
    error = std::max(error, own);
    chosen.push_back(sliders[to]);
    from = to;
  }
  return chosen;
}

void AddChain(Results& results, const Options& options, Targets& targets)
{
  // Errors are looked for in some places, and between these they are a little larger.
  constexpr double reserve = 0.75;
  double tolerance = reserve * options.Tolerance;
  const double end = SliderOf(options.MaximumRoundness);
  const auto most = 2 * static_cast<std::size_t>(options.MaximumNumber) + 3;
  const std::vector<double> jumps = Sample(results, end, tolerance, most);
  std::vector<double> sliders = results.Computed();
  const auto isNone = [&](double slider)
  { return slider > end || std::find(jumps.begin(), jumps.end(), slider) != jumps.end(); };
  sliders.erase(std::remove_if(sliders.begin(), sliders.end(), isNone), sliders.end());
  std::vector<double> chosen = Fewest(results, sliders, tolerance, targets.Error);
  while (chosen.size() > static_cast<std::size_t>(options.MaximumNumber) + 1)
  {
    tolerance *= 1.25;
    chosen = Fewest(results, sliders, tolerance, targets.Error);
  }
  for (const double jump : jumps)
  {
    const auto to = std::lower_bound(chosen.begin(), chosen.end(), jump);
    targets.Jump = std::max(targets.Jump, results.Distance(*std::prev(to), jump, *to));
  }
  for (std::size_t k = 1; k < chosen.size(); ++k)
  {
    targets.All.push_back({ chosen[k], results.MovesAt(chosen[k]), results.NormalsAt(chosen[k]) });
  }
}
} // namespace

double vtkRoundnessTargets::SliderOf(double roundness)
{
  const double mu = std::sqrt(3.0) * roundness;
  return mu / (1.0 + mu);
}

Rows vtkRoundnessTargets::RowsOf(vtkDataArray* array)
{
  Rows rows(array ? array->GetNumberOfTuples() : 0, 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
  {
    array->GetTuple(i, rows.row(i).data());
  }
  return rows;
}

double vtkRoundnessTargets::RoundnessOf(double slider)
{
  return slider / (1.0 - slider) / std::sqrt(3.0);
}

Targets vtkRoundnessTargets::Make(
  vtkPolyData* model, vtkSphericalStyleFilter* style, const Options& options)
{
  Targets targets;
  const bool mayBeLinear =
    style->GetDetailSize() == 0.0 && style->GetKeepSize() == vtkSphericalStyleFilter::NO_SIZE;
  Results results(model, style, options);
  targets.Model = results.Model;
  if (!mayBeLinear || !AddLine(results, targets))
  {
    AddChain(results, options, targets);
  }
  targets.Warnings = results.Filter.Heard;
  return targets;
}
