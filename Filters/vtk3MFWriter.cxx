// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtk3MFWriter.h"

#include "MeshDiagnosis.h"
#include "MeshEdges.h"
#include "MeshQuality.h"
#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"
#include "vtkWholeFile.h"
#include "vtkZipArchive.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using SphericalStyle::Points;
using SphericalStyle::Triangles;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtk3MFWriter);

namespace
{
// The names of the specification, in the order of vtk3MFWriter::Units.
constexpr std::array<const char*, 6> UnitNames = { "micron", "millimeter", "centimeter", "inch",
  "foot", "meter" };
constexpr std::array<double, 6> Millimeters = { 1e-3, 1.0, 10.0, 25.4, 304.8, 1000.0 };
constexpr double Tiny = 5.0; // millimeters

constexpr const char* ContentTypes =
  R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
  <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
  <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";

constexpr const char* Relationships =
  R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
  <Relationship Id="model" Target="/3D/3dmodel.model"
    Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";

/// What is written, and where it comes from.
struct SolidMesh
{
  SphericalStyle::TriangleMesh Mesh;  // points of triangles only
  std::vector<vtkIdType> InputPoints; // the first of each point
};

/// @param surface  with all points
SolidMesh TakeSolid(vtkPolyData* input, const vtkSurfaceMesh& surface)
{
  std::vector<std::array<int, 3>> triangles;
  const auto take = [&triangles](int a, int b, int c)
  {
    if (a != b && b != c && c != a) // the specification wants three points
    {
      triangles.push_back({ a, b, c });
    }
  };
  if (surface.DegenerateTriangles == 0)
  {
    for (const auto& t : surface.Mesh.F.rowwise())
    {
      take(t(0), t(1), t(2));
    }
  }
  else // those without an area count as well: the surface would be open without them
  {
    for (const auto& t : vtkSurfaceMeshConversion::Triangles(input))
    {
      take(surface.MeshPoint[t.Corners[0]], surface.MeshPoint[t.Corners[1]],
        surface.MeshPoint[t.Corners[2]]);
    }
  }
  std::vector<int> number(surface.Mesh.P.rows(), -1);
  for (const auto& t : triangles)
  {
    number[t[0]] = number[t[1]] = number[t[2]] = 0;
  }
  const std::vector<vtkIdType> inputPoints = surface.FirstInputPoints();
  SolidMesh solid;
  Points& P = solid.Mesh.P;
  P.resize(static_cast<Eigen::Index>(std::count(number.begin(), number.end(), 0)), 3);
  for (std::size_t i = 0; i < number.size(); ++i)
  {
    if (number[i] == 0)
    {
      number[i] = static_cast<int>(solid.InputPoints.size());
      P.row(number[i]) = surface.Mesh.P.row(static_cast<Eigen::Index>(i));
      solid.InputPoints.push_back(inputPoints[i]);
    }
  }
  Triangles& F = solid.Mesh.F;
  F.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      F(f, k) = number[triangles[f][k]];
    }
  }
  return solid;
}

/// Points at one place are one only where the surface would be open else, as along a seam of
/// textures: parts that touch are apart where the filter Printable took them apart.
SolidMesh TakeSolid(vtkPolyData* input, std::string& remark)
{
  using vtkSurfaceMeshConversion::FromPolyData;
  constexpr auto All = vtkSurfaceMeshConversion::TakePoints::All;
  vtkSurfaceMesh surface = FromPolyData(input, false, All);
  SolidMesh solid = TakeSolid(input, surface);
  const SphericalStyle::MeshEdges edges(solid.Mesh.F);
  bool isOpen = false;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    isOpen = isOpen || edges.GetValence(e) == 1;
  }
  if (isOpen)
  {
    surface = FromPolyData(input, true, All);
    solid = TakeSolid(input, surface);
  }
  remark = vtkSurfaceMeshConversion::FannedRemark(surface);
  return solid;
}

/// What the specification forbids, with numbers and first points; empty where there is nothing.
std::string Flaws(const SolidMesh& solid)
{
  struct Flaw
  {
    const char* Noun;
    const char* Rest;
    int Count = 0;
    int Point = -1;
  };
  std::array<Flaw, 4> flaws = { Flaw{ "border edge", "" },
    Flaw{ "edge", " of three or more faces" },
    Flaw{ "edge", " whose two faces disagree on the outside" },
    Flaw{ "closed part", " with the inside out" } };
  auto& [borders, crowded, turned, insideOut] = flaws;
  const Triangles& F = solid.Mesh.F;
  const SphericalStyle::MeshEdges edges(F);
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int valence = edges.GetValence(e);
    if (valence == 2 && SphericalStyle::EdgeBalance(F, edges, e) == 0)
    {
      continue;
    }
    Flaw& flaw = valence == 1 ? borders : valence == 2 ? turned : crowded;
    if (flaw.Count++ == 0)
    {
      const int h = edges.GetHalfEdges()[edges.GetOffset()[e]];
      flaw.Point = std::min(F(h / 3, (h + 1) % 3), F(h / 3, (h + 2) % 3));
    }
  }
  SphericalStyle::DiagnosisOptions options;
  options.weld = false; // where it has to be, it is
  const SphericalStyle::MeshDiagnosis diagnosis =
    SphericalStyle::Diagnose(solid.Mesh.P, F, options);
  constexpr SphericalStyle::Defect InsideOut = SphericalStyle::Defect::InsideOutComponents;
  insideOut.Count = diagnosis[InsideOut].count;
  insideOut.Point = std::numeric_limits<int>::max();
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    if ((diagnosis.triangleMarks[f] & SphericalStyle::Bit(InsideOut)) != 0)
    {
      insideOut.Point = std::min(insideOut.Point, F.row(f).minCoeff());
    }
  }
  std::string text;
  for (const Flaw& flaw : flaws)
  {
    if (flaw.Count > 0)
    {
      text += (text.empty() ? "" : "; ") + Count(flaw.Count, flaw.Noun) + flaw.Rest +
        ", the first at point " + std::to_string(solid.InputPoints[flaw.Point]);
    }
  }
  return text;
}

/// The fewest digits that give back the number, whatever the language of the system is.
template <typename Number>
void AppendDigits(std::string& text, Number number)
{
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), end);
}

/// The axis that vtkPrintableFilter says is up; z without it.
int UpAxisOf(vtkPolyData* input)
{
  constexpr int Z = 2;
  vtkDataArray* axis = input->GetFieldData()->GetArray("UpAxis");
  const double value =
    axis && axis->GetNumberOfValues() == 1 ? axis->GetComponent(0, 0) : static_cast<double>(Z);
  return value == 0.0 || value == 1.0 ? static_cast<int>(value) : Z;
}

/// The attribute that turns the axis up to z and puts the model onto the plate, as PlaceOnPlate of
/// vtkPrintableFilter does; empty where z is up already. Rows are multiplied from the left: those
/// of the axes, then the translation.
std::string TransformText(const Points& P, int upAxis)
{
  if (upAxis == 2)
  {
    return {};
  }
  Eigen::Matrix<double, 4, 3> transform = Eigen::Matrix<double, 4, 3>::Zero();
  for (int k = 0; k < 3; ++k)
  {
    const auto [axis, sign] = PlateAxes(upAxis)[k];
    const double low = P.col(axis).minCoeff();
    transform(axis, k) = sign;
    transform(3, k) = k == 2 ? -low : -sign * (0.5 * low + 0.5 * P.col(axis).maxCoeff());
  }
  std::string text;
  for (int i = 0; i < 4; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      text += text.empty() ? " transform=\"" : " ";
      AppendDigits(text, transform(i, k) + 0.0); // no -0
    }
  }
  return text + "\"";
}

/// 3D/3dmodel.model.
/// @param single  whether the coordinates are of single precision, which has fewer digits
std::string ModelText(
  const SphericalStyle::TriangleMesh& mesh, bool single, const char* unit, int upAxis)
{
  std::string text = R"(<?xml version="1.0" encoding="UTF-8"?>
<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xml:lang="en-US" unit=")";
  text += unit;
  text += R"(">
<metadata name="Application">SphericalStyle</metadata>
<resources>
<object id="1" type="model">
<mesh>
<vertices>
)";
  constexpr std::array<const char*, 3> Coordinates = { "<vertex x=\"", "\" y=\"", "\" z=\"" };
  for (const auto& point : mesh.P.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      text += Coordinates[k];
      if (single)
      {
        AppendDigits(text, static_cast<float>(point(k)));
      }
      else
      {
        AppendDigits(text, point(k));
      }
    }
    text += "\"/>\n";
  }
  text += "</vertices>\n<triangles>\n";
  constexpr std::array<const char*, 3> Corners = { "<triangle v1=\"", "\" v2=\"", "\" v3=\"" };
  for (const auto& triangle : mesh.F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      text += Corners[k];
      AppendDigits(text, triangle(k));
    }
    text += "\"/>\n";
  }
  text += R"(</triangles>
</mesh>
</object>
</resources>
<build>
<item objectid="1")";
  text += TransformText(mesh.P, upAxis);
  text += R"(/>
</build>
</model>
)";
  return text;
}

/// Of a model that was never made the size of a toy; empty where it is larger.
std::string TinyRemark(const Points& P, double millimeters)
{
  const double longest = (P.colwise().maxCoeff() - P.colwise().minCoeff()).maxCoeff() * millimeters;
  if (longest >= Tiny)
  {
    return {};
  }
  std::ostringstream text;
  text.precision(3);
  text << "The file is written, but the model is only " << longest
       << " mm long. Height of the filter Printable makes it larger, or choose another Unit";
  return text.str();
}
} // namespace

vtk3MFWriter::vtk3MFWriter() = default;

vtk3MFWriter::~vtk3MFWriter()
{
  this->vtk3MFWriter::SetFileName(nullptr);
}

int vtk3MFWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtk3MFWriter::Write()
{
  this->SetErrorCode(vtkErrorCode::UnknownError); // where the input fails WriteData is not called
  return this->Superclass::Write();
}

void vtk3MFWriter::WriteData()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkNew<vtkInformationVector> noOutputs;
  const auto execute = [this]
  {
    this->Execute(vtkPolyData::SafeDownCast(this->GetInput()));
    return 1;
  };
  if (RunGuarded(this, noOutputs, execute) == 0 && this->GetErrorCode() == vtkErrorCode::NoError)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
}

void vtk3MFWriter::Execute(vtkPolyData* input)
{
  const std::string name = this->FileName ? this->FileName : "";
  if (!vtkWholeFile::EndsIn(name, { ".3mf" }))
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    throw std::invalid_argument("FileName must end in .3mf; it is \"" + name + "\"");
  }
  if (!input || input->GetNumberOfPolys() + input->GetNumberOfStrips() == 0)
  {
    throw std::invalid_argument("the model has no faces");
  }
  std::string remark;
  const SolidMesh solid = TakeSolid(input, remark);
  if (solid.Mesh.F.rows() == 0)
  {
    throw std::invalid_argument("the model has no triangle with three different points");
  }
  this->UpdateProgress(0.2);
  Warn(this, remark);
  const std::string flaws = Flaws(solid);
  this->UpdateProgress(0.4);
  const bool single =
    vtkSurfaceMeshConversion::OutputPointType(input, vtkAlgorithm::DEFAULT_PRECISION) == VTK_FLOAT;
  vtkWholeFile::Naming(this->FileName,
    [&]
    {
      vtkZipArchive archive;
      archive.Add("[Content_Types].xml", ContentTypes);
      archive.Add("_rels/.rels", Relationships);
      archive.Add(
        "3D/3dmodel.model", ModelText(solid.Mesh, single, UnitNames[this->Unit], UpAxisOf(input)));
      this->UpdateProgress(0.9);
      archive.Write(this->FileName);
    });
  if (!flaws.empty())
  {
    Warn(this,
      "The file is written, but a slicer has to repair the surface: it has " + flaws +
        ". The filter Printable turns faces outward and fills holes; Surface Diagnostics shows all "
        "such places");
  }
  Warn(this, TinyRemark(solid.Mesh.P, Millimeters[this->Unit]));
  this->UpdateProgress(1.0);
}

void vtk3MFWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Unit: " << UnitNames[this->Unit] << "\n";
}
