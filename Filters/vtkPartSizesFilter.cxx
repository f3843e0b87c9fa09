// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPartSizesFilter.h"

#include "Frame.h"
#include "ModelSize.h"
#include "Orientation.h"
#include "PartSizes.h"
#include "vtkFilterSupport.h"
#include "vtkIdValues.h"
#include "vtkMovedSurface.h"
#include "vtkStyleArrays.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSurfacePartsFilter.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using SphericalStyle::Points;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkPartSizesFilter);

namespace
{
constexpr std::size_t MaximumNumberOfParts = 256; // each costs a field to smooth

std::string Text(double number)
{
  std::ostringstream text;
  text.precision(15);
  text << number;
  return text.str();
}

/// "0, 1, 2", the first ten.
std::string List(const std::vector<vtkIdType>& numbers)
{
  constexpr std::size_t Most = 10;
  std::string list;
  for (std::size_t k = 0; k < std::min(numbers.size(), Most); ++k)
  {
    list += (k > 0 ? ", " : "") + std::to_string(numbers[k]);
  }
  return list + (numbers.size() > Most ? ", ..." : "");
}

/// Three digits of a number above 0, rounded down or up.
std::string Digits(double number, bool up)
{
  const double unit = std::pow(10.0, std::floor(std::log10(number)) - 2.0);
  return Text((up ? std::ceil(number / unit) : std::floor(number / unit)) * unit);
}
}

/// One for each part.
struct vtkPartValues
{
  Eigen::VectorXd Values;
  std::vector<bool> Given; // whether a row says so

  bool Any() const
  {
    return std::find(this->Given.begin(), this->Given.end(), true) != this->Given.end();
  }
  /// What goes along with the head has its value, where it has none of its own.
  void GiveAlong(const SphericalStyle::Head& head)
  {
    for (const int k : head.along)
    {
      if (!this->Given[k])
      {
        this->Values(k) = this->Values(head.part);
        this->Given[k] = this->Given[head.part];
      }
    }
  }
};

/// What the array says, and the rows.
struct vtkResizedParts
{
  std::vector<int> OfPoints;      // of each mesh point, a place in the next
  std::vector<vtkIdType> Numbers; // in the array, ascending
  vtkPartValues Sizes;            // as wanted
  vtkPartValues Roundness;        // factors
  vtkPartValues NormalBlends;

  int Count() const { return static_cast<int>(this->Numbers.size()); }
  /// Of the part of that number; Count() if there is none.
  int Find(double number) const
  {
    const auto found = std::find_if(this->Numbers.begin(), this->Numbers.end(),
      [=](vtkIdType known) { return static_cast<double>(known) == number; });
    return static_cast<int>(found - this->Numbers.begin());
  }
  /// Of each part, the extent along an axis.
  std::vector<double> Heights(const Points& P, int axis) const
  {
    std::vector<double> low(this->Numbers.size(), HUGE_VAL);
    std::vector<double> heights(this->Numbers.size(), -HUGE_VAL);
    for (std::size_t i = 0; i < this->OfPoints.size(); ++i)
    {
      const double x = P(static_cast<Eigen::Index>(i), axis);
      low[this->OfPoints[i]] = std::min(low[this->OfPoints[i]], x);
      heights[this->OfPoints[i]] = std::max(heights[this->OfPoints[i]], x);
    }
    std::transform(heights.begin(), heights.end(), low.begin(), heights.begin(), std::minus<>());
    return heights;
  }
};

/// What is known of a surface, and the surface.
struct vtkPartSizesFilter::KnownParts
{
  SphericalStyle::TriangleMesh Mesh;
  std::vector<int> MeshPoint;
  vtkSmartPointer<vtkDataArray> FoundIds; // of the points of the input; none where they were given

  // Of these parts and this BlendWidth.
  std::vector<int> OfPoints;
  double BlendWidth = 0.0;
  std::shared_ptr<const SphericalStyle::PartSizes> Sized;

  explicit KnownParts(const vtkSurfaceMesh& surface)
    : Mesh(surface.Mesh)
    , MeshPoint(surface.MeshPoint)
  {
  }

  bool AreOf(const vtkSurfaceMesh& surface) const
  {
    return this->Mesh == surface.Mesh && this->MeshPoint == surface.MeshPoint;
  }

  /// @param P  in the frame
  std::shared_ptr<const SphericalStyle::PartSizes> SizedFor(
    const Points& P, const vtkResizedParts& parts, double blendWidth, int threads)
  {
    if (!this->Sized || this->OfPoints != parts.OfPoints || this->BlendWidth != blendWidth)
    {
      this->Sized = nullptr; // first, so that there are never two
      this->Sized = std::make_shared<SphericalStyle::PartSizes>(
        P, this->Mesh.F, parts.OfPoints, parts.Count(), blendWidth, threads);
      this->OfPoints = parts.OfPoints;
      this->BlendWidth = blendWidth;
    }
    return this->Sized;
  }
};

namespace
{
/// [head] What hangs on the head alone goes along with it.
/// @param P  in the frame @param number  of the head, or -1 @param wanted  HeadHeight
/// @return its number, -1 where there is only one part, which has no head
/// @throw std::invalid_argument
vtkIdType SizeHead(const SphericalStyle::PartSizes& sized, const Points& P,
  const SphericalStyle::Triangles& F, int number, int axis, double wanted, vtkResizedParts& parts)
{
  if (parts.Count() == 1)
  {
    return -1;
  }
  const int known = number == -1 ? -1 : parts.Find(number);
  if (known == parts.Count())
  {
    throw std::invalid_argument(
      "Head: there is no part " + std::to_string(number) + "; there are " + List(parts.Numbers));
  }
  const SphericalStyle::Head head = SphericalStyle::FindHead(
    sized, P, SphericalStyle::OrientAlike(P, F), parts.OfPoints, parts.Count(), axis, known);
  parts.Sizes.GiveAlong(head);
  parts.Roundness.GiveAlong(head);
  parts.NormalBlends.GiveAlong(head);
  Eigen::VectorXd& sizes = parts.Sizes.Values;
  if (wanted == 0.0)
  {
    return parts.Numbers[head.part];
  }
  const double factor =
    SphericalStyle::FactorForHeightRatio(sized, sizes, parts.OfPoints, head, axis, wanted);
  if (factor == 0.0)
  {
    const auto [least, most] =
      SphericalStyle::HeightRatiosInReach(sized, sizes, parts.OfPoints, head, axis);
    const std::string about = "HeadHeight: part " + std::to_string(parts.Numbers[head.part]);
    throw std::invalid_argument(least > 0.0 && std::isfinite(most)
        ? about + " can be made " + Digits(least, true) + " to " + Digits(most, false) +
          " times as high as the rest, by factors from 1/20 to 20, not " + Text(wanted) +
          "; choose another height, or see Head and UpAxis. A model that lies has no height of a "
          "head: set HeadHeight to 0 and give that part a row of PartSize, such as 1.5"
        : about + " or the rest has no height along UpAxis; choose another axis, or see Head");
  }
  sizes(head.part) *= factor;
  for (const int k : head.along)
  {
    sizes(k) *= factor;
  }
  return parts.Numbers[head.part];
}

/// Of a head that there is not. @param wanted  HeadHeight
std::string HeadRemark(const vtkResizedParts& parts, double wanted)
{
  return parts.Count() == 1 && wanted > 0.0
    ? "HeadHeight has no effect: the model has only one part, so there is no rest to compare a "
      "head "
      "with; make 2 or more with NumberOfParts of Surface Parts"
    : "";
}

/// Of styles for a model that is rounded already.
std::string LateRemark(vtkPolyData* input, const vtkResizedParts& parts)
{
  const bool late = (parts.Roundness.Any() || parts.NormalBlends.Any()) &&
    input->GetPointData()->HasArray("TargetDirection");
  return late ? "The model is rounded already. Rows of PartRoundness and PartNormalBlend say how a "
                "Spherical Style that comes after this filter rounds: put this filter before it"
              : "";
}

void MakeTable(vtkTable* table, const vtkResizedParts& parts, const std::vector<double>& heights,
  const std::vector<double>& newHeights)
{
  table->Initialize(); // an observer of progress may have asked for an update, which filled it
  vtkNew<vtkIdTypeArray> number;
  vtkNew<vtkDoubleArray> size, before, after;
  for (int k = 0; k < parts.Count(); ++k)
  {
    number->InsertNextValue(parts.Numbers[k]);
    size->InsertNextValue(parts.Sizes.Values(k));
    before->InsertNextValue(heights[k]);
    after->InsertNextValue(newHeights[k]);
  }
  AddColumn(table, number, "Part");
  AddColumn(table, size, "Size");
  AddColumn(table, before, "HeightBefore");
  AddColumn(table, after, "Height");
}

/// The arrays of [styles], where there are rows for them.
void AddStyles(vtkPolyData* output, const vtkSurfaceMesh& surface, const vtkResizedParts& parts,
  const SphericalStyle::Fields& shares)
{
  const int type = output->GetPoints()->GetDataType() == VTK_DOUBLE ? VTK_DOUBLE : VTK_FLOAT;
  const auto add = [&](const char* name, const vtkSurfaceMeshConversion::Rows& rows)
  { vtkSurfaceMeshConversion::AddPointArray(output, surface, name, type, rows); };
  if (parts.Roundness.Any())
  {
    add(vtkStyleArrays::PartRoundness, shares * parts.Roundness.Values);
  }
  if (parts.NormalBlends.Any())
  {
    Eigen::VectorXd given(parts.Count());
    for (int k = 0; k < parts.Count(); ++k)
    {
      given(k) = parts.NormalBlends.Given[k] ? 1.0 : 0.0;
    }
    const Eigen::VectorXd weight = (shares * given).cwiseMin(1.0);
    const Eigen::VectorXd sum = shares * given.cwiseProduct(parts.NormalBlends.Values);
    vtkSurfaceMeshConversion::Rows rows(weight.size(), 2);
    rows.col(0) = (weight.array() > 0.0).select(sum.cwiseQuotient(weight), 0.0).cwiseMin(1.0);
    rows.col(1) = weight;
    add(vtkStyleArrays::PartNormalBlend, rows);
  }
}
}

vtkPartSizesFilter::vtkPartSizesFilter()
{
  this->SetNumberOfOutputPorts(2);
}

vtkPartSizesFilter::~vtkPartSizesFilter() = default;

void vtkPartSizesFilter::SetRow(Rows& rows, double part, double value)
{
  if (std::isnan(part)) // which has no place among numbers
  {
    vtkErrorMacro("A part must be a number; it is nan");
    return;
  }
  const auto [at, isNew] = rows.Values.emplace(part, value);
  if (isNew || at->second != value)
  {
    at->second = value;
    this->Modified();
  }
  if (rows.Repeated.erase(part) > 0)
  {
    this->Modified();
  }
}

void vtkPartSizesFilter::AddRow(Rows& rows, double part, double value)
{
  const bool isRepeated = rows.Values.count(part) > 0;
  this->SetRow(rows, part, value);
  if (isRepeated && rows.Repeated.insert(part).second)
  {
    this->Modified();
  }
}

double vtkPartSizesFilter::GetRow(const Rows& rows, double part, double otherwise)
{
  const auto found = rows.Values.find(part);
  return found == rows.Values.end() ? otherwise : found->second;
}

void vtkPartSizesFilter::RemoveRows(Rows& rows)
{
  if (!rows.Values.empty())
  {
    rows = {};
    this->Modified();
  }
}

void vtkPartSizesFilter::SetPartSize(double part, double size)
{
  this->SetRow(this->Sizes, part, size);
}

void vtkPartSizesFilter::AddPartSize(double part, double size)
{
  this->AddRow(this->Sizes, part, size);
}

double vtkPartSizesFilter::GetPartSize(double part)
{
  return GetRow(this->Sizes, part, 1.0);
}

void vtkPartSizesFilter::RemoveAllPartSizes()
{
  this->RemoveRows(this->Sizes);
}

void vtkPartSizesFilter::SetPartRoundness(double part, double factor)
{
  this->SetRow(this->Roundness, part, factor);
}

void vtkPartSizesFilter::AddPartRoundness(double part, double factor)
{
  this->AddRow(this->Roundness, part, factor);
}

double vtkPartSizesFilter::GetPartRoundness(double part)
{
  return GetRow(this->Roundness, part, 1.0);
}

void vtkPartSizesFilter::RemoveAllPartRoundnesses()
{
  this->RemoveRows(this->Roundness);
}

void vtkPartSizesFilter::SetPartNormalBlend(double part, double blend)
{
  this->SetRow(this->NormalBlends, part, blend);
}

void vtkPartSizesFilter::AddPartNormalBlend(double part, double blend)
{
  this->AddRow(this->NormalBlends, part, blend);
}

double vtkPartSizesFilter::GetPartNormalBlend(double part)
{
  return GetRow(this->NormalBlends, part, -1.0);
}

void vtkPartSizesFilter::RemoveAllPartNormalBlends()
{
  this->RemoveRows(this->NormalBlends);
}

int vtkPartSizesFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkPartSizesFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(this, outputVector, [&] { return this->Execute(inputVector, outputVector); });
}

int vtkPartSizesFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  namespace Conversion = vtkSurfaceMeshConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  this->EffectiveHead = -1;
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  this->CheckProperties();
  const vtkSurfaceMesh surface = Conversion::FromPolyData(input, true);
  vtkDataArray* ids = this->FindIds(input);
  const bool areFound = ids == nullptr;
  const std::shared_ptr<KnownParts> known = this->Know(input, surface, areFound);
  if (!known)
  {
    return 1; // aborted: nothing comes out, as everywhere in VTK
  }
  ids = areFound ? known->FoundIds.Get() : ids;
  vtkResizedParts parts = this->TakeParts(ids, input->GetNumberOfPoints(), surface);
  Warn(this, Conversion::FannedRemark(surface));
  Warn(this, Conversion::SkippedRemark(surface));
  Warn(this, LateRemark(input, parts));
  Warn(this, HeadRemark(parts, this->HeadHeight));
  Points Q = surface.Mesh.P;
  SphericalStyle::Fields shares;
  if (surface.Mesh.F.rows() > 0)
  {
    const SphericalStyle::Frame frame = SphericalStyle::FrameOf(surface.Mesh.P);
    const Points P = frame.Into(surface.Mesh.P);
    const int threads = ThreadsToUse(this->NumberOfThreads);
    this->SetProgressText("Resizing parts");
    this->UpdateProgress(0.1);
    const auto sized = known->SizedFor(P, parts, this->BlendWidth, threads);
    this->UpdateProgress(0.8);
    if (Aborted(this))
    {
      return 1; // nothing comes out, as everywhere in VTK
    }
    if (this->HeadHeight > 0.0 || !this->Sizes.Values.empty() || !this->Roundness.Values.empty() ||
      !this->NormalBlends.Values.empty())
    {
      this->EffectiveHead =
        SizeHead(*sized, P, surface.Mesh.F, this->Head, this->UpAxis, this->HeadHeight, parts);
    }
    shares = sized->GetShares();
    if ((parts.Sizes.Values.array() != 1.0).any()) // else to the bit
    {
      Points moved = sized->Sized(parts.Sizes.Values);
      SphericalStyle::SizeOptions place;
      place.up = Eigen::Vector3d::Unit(this->UpAxis);
      place.keepOnGround = this->KeepOnGround;
      std::vector<int> all(P.rows());
      std::iota(all.begin(), all.end(), 0);
      SphericalStyle::RestoreSize(P, surface.Mesh.F, all, {}, place, 1.0, threads, moved);
      Q = frame.OutOf(std::move(moved));
    }
  }
  output->ShallowCopy(input);
  if (areFound)
  {
    output->GetPointData()->AddArray(ids);
  }
  vtkMovedSurface::Fill(this, output, surface, Q);
  Conversion::AddDisplacement(output, input);
  if (shares.rows() > 0)
  {
    AddStyles(output, surface, parts, shares);
  }
  MakeTable(vtkTable::GetData(outputVector, 1), parts, parts.Heights(surface.Mesh.P, this->UpAxis),
    parts.Heights(Q, this->UpAxis));
  return 1;
}

void vtkPartSizesFilter::CheckProperties() const
{
  for (const auto& [part, size] : this->Sizes.Values)
  {
    Require(
      size > 0.0 && std::isfinite(size), ("Size of part " + Text(part)).c_str(), "above 0", size);
  }
  for (const auto& [part, factor] : this->Roundness.Values)
  {
    Require(factor >= 0.0 && std::isfinite(factor), ("Roundness of part " + Text(part)).c_str(),
      "0 or more", factor);
  }
  for (const auto& [part, blend] : this->NormalBlends.Values)
  {
    Require(blend >= 0.0 && blend <= 1.0, ("NormalBlend of part " + Text(part)).c_str(), "in 0..1",
      blend);
  }
  Require(this->HeadHeight >= 0.0 && std::isfinite(this->HeadHeight), "HeadHeight", "0 or more",
    this->HeadHeight);
  Require(this->BlendWidth >= 0.01 && this->BlendWidth <= 1.0, "BlendWidth", "in 0.01..1",
    this->BlendWidth);
}

namespace
{
constexpr const char* PurposeOfIds = "Part id";
}

/// The array that numbers the parts, or nullptr where none is chosen and there is no PartId.
/// @throw std::invalid_argument
vtkDataArray* vtkPartSizesFilter::FindIds(vtkPolyData* input)
{
  vtkDataArray* chosen = vtkSurfaceMeshConversion::FindPointArray(
    this->GetInputArrayInformation(0), input, PurposeOfIds);
  return chosen ? chosen : input->GetPointData()->GetArray("PartId");
}

/// @param search  whether parts are to be looked for, where that was not done
/// @return nullptr after an abort
std::shared_ptr<vtkPartSizesFilter::KnownParts> vtkPartSizesFilter::Know(
  vtkPolyData* input, const vtkSurfaceMesh& surface, bool search)
{
  // Held here: an observer of progress may ask for an update of another surface.
  std::shared_ptr<KnownParts> known = this->Known;
  const bool isSame = known && known->AreOf(surface);
  vtkSmartPointer<vtkDataArray> found = isSame ? known->FoundIds : nullptr;
  if (search && !found)
  {
    found = this->FindParts(input);
    if (!found)
    {
      return nullptr;
    }
  }
  if (!isSame)
  {
    known = std::make_shared<KnownParts>(surface);
  }
  known->FoundIds = found;
  this->Known = known;
  return known;
}

/// As vtkSurfacePartsFilter numbers them. @return nullptr after an abort
vtkSmartPointer<vtkDataArray> vtkPartSizesFilter::FindParts(vtkPolyData* input)
{
  this->SetProgressText("Looking for parts");
  vtkNew<vtkPolyData> bare;
  bare->CopyStructure(input);
  vtkNew<vtkSurfacePartsFilter> finder;
  finder->SetController(nullptr); // the surface is all here, and other processes are not asked
  finder->SetInputData(bare);
  vtkNew<vtkCallbackCommand> silence; // this filter gives the same remarks, and says what failed
  finder->AddObserver(vtkCommand::WarningEvent, silence);
  finder->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silence);
  std::string failure;
  vtkNew<vtkCallbackCommand> listen;
  listen->SetClientData(&failure);
  listen->SetCallback([](vtkObject*, unsigned long, void* said, void* text)
    { *static_cast<std::string*>(said) = PlainMessage(static_cast<const char*>(text)); });
  finder->AddObserver(vtkCommand::ErrorEvent, listen);
  vtkNew<vtkCallbackCommand> progress;
  progress->SetClientData(this);
  progress->SetCallback(
    [](vtkObject* caller, unsigned long, void* self, void*)
    {
      auto* looking = vtkAlgorithm::SafeDownCast(caller);
      auto* filter = static_cast<vtkPartSizesFilter*>(self);
      if (!Aborted(filter))
      {
        filter->UpdateProgress(0.1 * looking->GetProgress());
      }
      looking->SetAbortExecute(Aborted(filter) ? 1 : 0);
    });
  finder->AddObserver(vtkCommand::ProgressEvent, progress);
  finder->Update();
  if (Aborted(this))
  {
    return nullptr;
  }
  vtkDataArray* ids = finder->GetOutput()->GetPointData()->GetArray("PartId");
  if (!ids)
  {
    throw std::runtime_error("the search for parts failed (" +
      (failure.empty() ? "not enough memory" : failure) + // also for the message
      "); choose an array of points as PartArray");
  }
  return ids;
}

/// @throw std::invalid_argument
vtkResizedParts vtkPartSizesFilter::TakeParts(
  vtkDataArray* ids, vtkIdType numberOfPoints, const vtkSurfaceMesh& surface)
{
  vtkResizedParts parts;
  const vtkIdValues given(ids, PurposeOfIds, numberOfPoints, "point");
  parts.OfPoints = vtkIdValues::Ranks(given.OfMesh(surface), parts.Numbers);
  if (parts.Numbers.size() > MaximumNumberOfParts)
  {
    throw std::invalid_argument(given.GetName() + " has " + std::to_string(parts.Numbers.size()) +
      " different values; there can be " + std::to_string(MaximumNumberOfParts) + " parts");
  }
  this->TakeRows(this->Sizes, "size", parts, parts.Sizes);
  this->TakeRows(this->Roundness, "roundness", parts, parts.Roundness);
  this->TakeRows(this->NormalBlends, "blend", parts, parts.NormalBlends);
  return parts;
}

/// @param name  of the values, for messages
void vtkPartSizesFilter::TakeRows(
  const Rows& rows, const char* name, const vtkResizedParts& parts, vtkPartValues& values)
{
  values.Values = Eigen::VectorXd::Ones(parts.Count());
  values.Given.resize(parts.Numbers.size());
  for (const auto& [part, value] : rows.Values)
  {
    const int at = parts.Find(part);
    if (at < parts.Count())
    {
      values.Values(at) = value;
      values.Given[at] = true;
    }
    else if (parts.Count() > 0)
    {
      Warn(this,
        "There is no part " + Text(part) + " to be given a " + name + "; there are " +
          List(parts.Numbers));
    }
  }
  for (const double part : rows.Repeated)
  {
    Warn(this,
      "Part " + Text(part) + " has more than one " + name +
        "; the last one counts: " + Text(rows.Values.at(part)));
  }
}

void vtkPartSizesFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const Rows& rows)
  {
    os << indent << name << ":";
    for (const auto& [part, value] : rows.Values)
    {
      os << " " << part << ": " << value;
    }
    os << "\n";
  };
  print("PartSizes", this->Sizes);
  print("PartRoundness", this->Roundness);
  print("PartNormalBlend", this->NormalBlends);
  os << indent << "BlendWidth: " << this->BlendWidth << "\n";
  os << indent << "HeadHeight: " << this->HeadHeight << "\n";
  os << indent << "Head: " << this->Head << "\n";
  os << indent << "EffectiveHead: " << this->EffectiveHead << "\n";
  os << indent << "KeepOnGround: " << OnOff(this->KeepOnGround) << "\n";
  os << indent << "UpAxis: " << this->UpAxis << "\n";
}
