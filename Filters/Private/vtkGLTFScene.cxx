// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGLTFScene.h"

#include "vtkSurfaceMeshConversion.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using Json = vtkGLTFDocument::Json;
using Use = vtkGLTFDocument::Use;
using vtkGLTFScene::Placement;
using vtkGLTFScene::Scene;

namespace
{
using Matrices = std::vector<Eigen::Matrix4d>;

// ------------------------------------------------------------------------------------ a new file
/// The numbers of an array, the first components of each tuple.
std::vector<float> FloatsOf(vtkDataArray* array, int components)
{
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(array->GetNumberOfTuples()) * components);
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      values.push_back(static_cast<float>(array->GetComponent(i, c)));
    }
  }
  return values;
}

/// Of length 1; points of no face have none, but a file must name some.
std::vector<float> UnitNormals(vtkDataArray* array)
{
  std::vector<float> values;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    Eigen::Vector3d n;
    array->GetTuple(i, n.data());
    const double length = n.norm();
    n = std::isfinite(length) && length > 0.0 ? Eigen::Vector3d(n / length)
                                              : Eigen::Vector3d(0.0, 0.0, 1.0);
    for (int c = 0; c < 3; ++c)
    {
      values.push_back(static_cast<float>(n(c)));
    }
  }
  return values;
}

bool CanBeColors(vtkDataArray* array)
{
  return array && (array->GetNumberOfComponents() == 3 || array->GetNumberOfComponents() == 4);
}

/// The active scalars, or else the first array of bytes; nullptr where there are no colors.
vtkDataArray* ColorsOf(vtkPointData* data)
{
  vtkDataArray* const scalars = data->GetScalars();
  if (CanBeColors(scalars))
  {
    double range[2] = { 0.0, 1.0 };
    for (int c = 0; c < scalars->GetNumberOfComponents(); ++c)
    {
      double own[2];
      scalars->GetRange(own, c);
      range[0] = std::min(range[0], own[0]);
      range[1] = std::max(range[1], own[1]);
    }
    const bool bytes = scalars->GetDataType() == VTK_UNSIGNED_CHAR;
    if (bytes || (range[0] >= 0.0 && range[1] <= 1.0))
    {
      return scalars;
    }
  }
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    auto* const array = vtkUnsignedCharArray::SafeDownCast(data->GetAbstractArray(k));
    if (CanBeColors(array))
    {
      return array;
    }
  }
  return nullptr;
}

vtkGLTFDocument::Bytes BytesOf(vtkDataArray* colors)
{
  const double scale = colors->GetDataType() == VTK_UNSIGNED_CHAR ? 1.0 : 255.0;
  vtkGLTFDocument::Bytes rgba;
  rgba.reserve(static_cast<std::size_t>(colors->GetNumberOfTuples()) * 4);
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < 4; ++c)
    {
      const double value =
        c < colors->GetNumberOfComponents() ? colors->GetComponent(i, c) * scale : 255.0;
      rgba.push_back(static_cast<unsigned char>(std::lround(std::clamp(value, 0.0, 255.0))));
    }
  }
  return rgba;
}

// ------------------------------------------------------------------------------- a file that
// exists
/// Numbers of a vector or matrix, or nothing where the key is absent.
std::vector<double> Numbers(
  const Json& object, const char* key, std::size_t count, const std::string& owner)
{
  const auto found = object.find(key);
  if (found == object.end())
  {
    return {};
  }
  std::vector<double> values;
  if (found->is_array())
  {
    for (const Json& value : *found)
    {
      values.push_back(value.is_number() ? value.get<double>() : std::nan(""));
    }
  }
  const bool finite =
    std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if (values.size() != count || !finite)
  {
    throw std::runtime_error(
      owner + ": its " + key + " must be " + std::to_string(count) + " numbers");
  }
  return values;
}

Eigen::Matrix4d LocalMatrix(const Json& node, const std::string& owner)
{
  const std::vector<double> matrix = Numbers(node, "matrix", 16, owner);
  if (!matrix.empty())
  {
    return Eigen::Map<const Eigen::Matrix4d>(matrix.data());
  }
  const std::vector<double> t = Numbers(node, "translation", 3, owner);
  const std::vector<double> r = Numbers(node, "rotation", 4, owner);
  const std::vector<double> s = Numbers(node, "scale", 3, owner);
  Eigen::Affine3d local = Eigen::Affine3d::Identity();
  if (!t.empty())
  {
    local.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  }
  if (!r.empty())
  {
    local.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
  }
  if (!s.empty())
  {
    local.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  }
  return local.matrix();
}

std::string NodeName(std::size_t node)
{
  return "node " + std::to_string(node);
}

/// The nodes of the scene that is shown, in its order, with where they are.
class Nodes
{
public:
  explicit Nodes(const vtkGLTFDocument& document)
    : Document(document)
  {
    const auto scenes = document.Root.find("scenes");
    if (scenes != document.Root.end() && !scenes->empty())
    {
      const std::size_t scene = vtkGLTFDocument::Number(document.Root, "scene", 0, "the file");
      this->AddAll(document.Item("scenes", scene, "the file"), "nodes", Eigen::Matrix4d::Identity(),
        "scene " + std::to_string(scene));
    }
  }

  std::vector<std::pair<std::size_t, Eigen::Matrix4d>> Shown;

private:
  void AddAll(
    const Json& object, const char* key, const Eigen::Matrix4d& parent, const std::string& owner)
  {
    const auto found = object.find(key);
    if (found == object.end())
    {
      return;
    }
    for (const Json& number : *found)
    {
      if (!number.is_number_integer() || number < 0)
      {
        throw std::runtime_error(owner + ": its " + key + " are not numbers of nodes");
      }
      this->Add(number.get<std::size_t>(), parent, owner);
    }
  }

  void Add(std::size_t index, const Eigen::Matrix4d& parent, const std::string& owner)
  {
    constexpr int deepest = 1000; // keeps the recursion within the stack
    const Json& node = this->Document.Item("nodes", index, owner);
    if (!this->Seen.insert(index).second || this->Depth == deepest)
    {
      throw std::runtime_error(NodeName(index) + ": the nodes are not a tree");
    }
    const Eigen::Matrix4d here = parent * LocalMatrix(node, NodeName(index));
    this->Shown.emplace_back(index, here);
    ++this->Depth;
    this->AddAll(node, "children", here, NodeName(index));
    --this->Depth;
  }

  const vtkGLTFDocument& Document;
  std::set<std::size_t> Seen;
  int Depth = 0;
};

/// Collects the surface of a document.
class Gatherer
{
public:
  explicit Gatherer(vtkGLTFDocument& document)
    : Document(document)
    , All(document)
  {
    // In single precision the points of a seam between two nodes are the same again. GCC 12 leaves
    // that rounding out where two doubles side by side become floats and doubles again.
    this->Points->SetDataTypeToFloat();
    this->Normals->SetName("Normals");
    this->Normals->SetNumberOfComponents(3);
  }

  Scene Gather()
  {
    std::set<std::size_t> taken;
    for (const auto& [node, matrix] : this->All.Shown)
    {
      const std::size_t mesh = vtkGLTFDocument::Number(
        this->Document.Root["nodes"][node], "mesh", vtkGLTFDocument::None, NodeName(node));
      if (mesh != vtkGLTFDocument::None)
      {
        this->Document.Item("meshes", mesh, NodeName(node));
        this->AddMesh(node, taken.insert(mesh).second ? mesh : this->Repeat(node, mesh), matrix);
      }
    }
    Scene scene;
    scene.Surface = vtkSmartPointer<vtkPolyData>::New();
    scene.Surface->SetPoints(this->Points);
    scene.Surface->SetPolys(this->Triangles);
    scene.HasNormals = this->AnyNormals;
    if (this->AnyNormals && !this->FacesWithoutNormals)
    {
      scene.Surface->GetPointData()->SetNormals(this->Normals); // else the filter makes some
    }
    scene.Placements = std::move(this->Placements);
    return scene;
  }

private:
  /// A copy of the mesh for another node that shows it.
  std::size_t Repeat(std::size_t node, std::size_t mesh)
  {
    const Json copy = this->Document.Root["meshes"][mesh];
    this->Document.Root["meshes"].push_back(copy);
    const std::size_t number = this->Document.Root["meshes"].size() - 1;
    this->Document.Root["nodes"][node]["mesh"] = number;
    return number;
  }

  /// What brings points into the scene that only one bone moves, for each bone of the node's skin;
  /// none without a skin.
  Matrices BonesOf(std::size_t node) const
  {
    const Json& json = this->Document.Root["nodes"][node];
    const std::size_t number =
      vtkGLTFDocument::Number(json, "skin", vtkGLTFDocument::None, NodeName(node));
    if (number == vtkGLTFDocument::None)
    {
      return {};
    }
    const Json& skin = this->Document.Item("skins", number, NodeName(node));
    const std::string owner = "skin " + std::to_string(number);
    const auto joints = skin.find("joints");
    if (joints == skin.end() || !joints->is_array() || joints->empty())
    {
      throw std::runtime_error(owner + ": has no joints");
    }
    std::vector<double> inverseBind;
    if (skin.contains("inverseBindMatrices"))
    {
      inverseBind =
        this->Document.Values(vtkGLTFDocument::Index(skin, "inverseBindMatrices", owner), "MAT4");
      if (inverseBind.size() < 16 * joints->size())
      {
        throw std::runtime_error(owner + ": has " + std::to_string(inverseBind.size() / 16) +
          " inverse bind matrices for " + std::to_string(joints->size()) + " joints");
      }
    }
    const std::map<std::size_t, Eigen::Matrix4d> places(
      this->All.Shown.begin(), this->All.Shown.end());
    Matrices bones;
    bones.reserve(joints->size());
    for (const Json& joint : *joints)
    {
      if (!joint.is_number_unsigned())
      {
        throw std::runtime_error(owner + ": its joints are not numbers of nodes");
      }
      const auto place = places.find(joint.get<std::size_t>());
      if (place == places.end())
      {
        bones.emplace_back(Eigen::Matrix4d::Identity()); // a bone that is not in the scene
      }
      else if (inverseBind.empty())
      {
        bones.push_back(place->second);
      }
      else
      {
        bones.emplace_back(place->second *
          Eigen::Map<const Eigen::Matrix4d>(inverseBind.data() + 16 * bones.size()));
      }
    }
    return bones;
  }

  /// What the bones make of each point: the mean of their matrices with the point's weights. A
  /// point without weights goes with the first bone.
  Matrices Posed(const Json& attributes, const Matrices& bones, std::size_t count,
    const std::string& owner) const
  {
    Matrices sums(count, Eigen::Matrix4d::Zero());
    std::vector<double> weightOf(count, 0.0);
    for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set)
    {
      const auto valuesOf = [&](const std::string& key)
      {
        return this->Document.Values(
          vtkGLTFDocument::Index(attributes, (key + std::to_string(set)).c_str(), owner), "VEC4");
      };
      const std::vector<double> joints = valuesOf("JOINTS_");
      const std::vector<double> weights = valuesOf("WEIGHTS_");
      if (joints.size() != 4 * count || weights.size() != 4 * count)
      {
        throw std::runtime_error(owner + ": has joints for " + std::to_string(joints.size() / 4) +
          " and weights for " + std::to_string(weights.size() / 4) + " of its " +
          std::to_string(count) + " points");
      }
      for (std::size_t k = 0; k < joints.size(); ++k)
      {
        if (!(weights[k] > 0.0))
        {
          continue;
        }
        if (!(joints[k] >= 0.0 && joints[k] < static_cast<double>(bones.size())))
        {
          throw std::runtime_error(owner + ", point " + std::to_string(k / 4) +
            ": its skin has only " + std::to_string(bones.size()) + " joints");
        }
        sums[k / 4] += weights[k] * bones[static_cast<std::size_t>(joints[k])];
        weightOf[k / 4] += weights[k];
      }
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      sums[i] = weightOf[i] > 0.0 ? Eigen::Matrix4d(sums[i] / weightOf[i]) : bones.front();
    }
    return sums;
  }

  /// @param matrix  what brings the node into the scene; with bones it does not matter
  void AddMesh(std::size_t node, std::size_t mesh, const Eigen::Matrix4d& matrix)
  {
    const Json& json = this->Document.Root["meshes"][mesh];
    const auto primitives = json.find("primitives");
    if (primitives == json.end() || !primitives->is_array())
    {
      throw std::runtime_error("mesh " + std::to_string(mesh) + ": has no primitives");
    }
    Placement placement;
    placement.Mesh = mesh;
    placement.Node = node;
    const Matrices bones = this->BonesOf(node);
    for (std::size_t k = 0; k < primitives->size(); ++k)
    {
      placement.Primitive = k;
      this->AddPrimitive((*primitives)[k], matrix, bones, placement,
        "mesh " + std::to_string(mesh) + ", primitive " + std::to_string(k));
    }
  }

  void AddPrimitive(const Json& primitive, const Eigen::Matrix4d& matrix, const Matrices& bones,
    Placement placement, const std::string& owner)
  {
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object())
    {
      throw std::runtime_error(owner + ": has no attributes");
    }
    const std::vector<double> place =
      this->Document.Values(vtkGLTFDocument::Index(*attributes, "POSITION", owner), "VEC3");
    placement.First = static_cast<std::size_t>(this->Points->GetNumberOfPoints());
    placement.Count = place.size() / 3;
    placement.HasNormals = attributes->contains("NORMAL");
    const Matrices matrices =
      bones.empty() ? Matrices{ matrix } : this->Posed(*attributes, bones, placement.Count, owner);
    const auto matrixOf = [&](std::size_t point) -> const Eigen::Matrix4d&
    { return bones.empty() ? matrices.front() : matrices[point]; };
    placement.Linear.clear();
    for (const Eigen::Matrix4d& here : matrices)
    {
      placement.Linear.emplace_back(here.topLeftCorner<3, 3>());
    }
    if (bones.empty() && vtkGLTFScene::IsFlat(placement.Linear.front()))
    {
      throw std::runtime_error(NodeName(placement.Node) +
        ": is flattened by a scale of 0, so its points cannot be moved in space; apply or change "
        "it");
    }
    for (std::size_t k = 0; k < place.size(); k += 3)
    {
      const Eigen::Vector3d here =
        (matrixOf(k / 3) * Eigen::Vector4d(place[k], place[k + 1], place[k + 2], 1.0)).head<3>();
      if (!(here.array().abs() <= std::numeric_limits<float>::max()).all())
      {
        throw std::runtime_error(owner + ", point " + std::to_string(k / 3) +
          ": is not finite, or too far out for single precision, where " +
          NodeName(placement.Node) + " places it");
      }
      this->Points->InsertNextPoint(here.data());
    }
    std::vector<double> normals(place.size(), 0.0);
    if (placement.HasNormals)
    {
      this->AnyNormals = true;
      normals = this->Document.Values(vtkGLTFDocument::Index(*attributes, "NORMAL", owner), "VEC3");
      if (normals.size() != place.size())
      {
        throw std::runtime_error(owner + ": has " + std::to_string(normals.size() / 3) +
          " normals for " + std::to_string(placement.Count) + " points");
      }
    }
    for (std::size_t k = 0; k < normals.size(); k += 3)
    {
      const Eigen::Matrix3d& linear = placement.LinearOf(k / 3);
      Eigen::Vector3d n(normals[k], normals[k + 1], normals[k + 2]);
      n = vtkGLTFScene::IsFlat(linear) ? Eigen::Vector3d(linear * n)
                                       : Eigen::Vector3d(linear.inverse().transpose() * n);
      n.normalize(); // or stays 0
      this->Normals->InsertNextTuple(n.data());
    }
    this->AddTriangles(primitive, placement, owner);
    this->Placements.push_back(placement);
  }

  void AddTriangles(const Json& primitive, const Placement& placement, const std::string& owner)
  {
    enum Modes : std::size_t
    {
      TRIANGLES = 4,
      STRIP = 5,
      FAN = 6
    };
    const std::size_t mode = vtkGLTFDocument::Number(primitive, "mode", TRIANGLES, owner);
    if (mode < TRIANGLES || mode > FAN)
    {
      return; // lines and points stay where they are
    }
    this->FacesWithoutNormals = this->FacesWithoutNormals || !placement.HasNormals;
    std::vector<double> corners;
    if (primitive.contains("indices"))
    {
      corners =
        this->Document.Values(vtkGLTFDocument::Index(primitive, "indices", owner), "SCALAR");
    }
    else
    {
      for (std::size_t k = 0; k < placement.Count; ++k)
      {
        corners.push_back(static_cast<double>(k));
      }
    }
    const auto count = static_cast<double>(placement.Count);
    for (std::size_t k = 0; k + 2 < corners.size(); k += mode == TRIANGLES ? 3 : 1)
    {
      std::array<double, 3> triangle = { corners[mode == FAN ? 0 : k], corners[k + 1],
        corners[k + 2] };
      for (const double corner : triangle)
      {
        if (!(corner >= 0.0 && corner < count))
        {
          throw std::runtime_error(owner + ": an index is not below the number of its points, " +
            std::to_string(placement.Count));
        }
      }
      const bool odd = mode == STRIP && k % 2 == 1;
      const auto first = static_cast<std::size_t>(triangle[0]);
      const bool mirrored = placement.LinearOf(first).determinant() < 0.0;
      if (odd != mirrored)
      {
        std::swap(triangle[1], triangle[2]);
      }
      this->Triangles->InsertNextCell(3);
      for (const double corner : triangle)
      {
        this->Triangles->InsertCellPoint(
          static_cast<vtkIdType>(placement.First) + static_cast<vtkIdType>(corner));
      }
    }
  }

  vtkGLTFDocument& Document;
  const Nodes All;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkFloatArray> Normals;
  vtkNew<vtkCellArray> Triangles;
  bool AnyNormals = false;
  bool FacesWithoutNormals = false;
  std::vector<Placement> Placements;
};
} // namespace

bool vtkGLTFScene::IsFlat(const Eigen::Matrix3d& linear)
{
  const double size = linear.norm();
  return !(std::abs(linear.determinant()) > 1e-9 * size * size * size);
}

namespace
{
/// The arrays with a value for each point; others belong to none.
vtkSmartPointer<vtkPointData> FittingArrays(vtkPolyData* surface)
{
  auto data = vtkSmartPointer<vtkPointData>::New();
  data->ShallowCopy(surface->GetPointData());
  for (int k = data->GetNumberOfArrays(); k-- > 0;)
  {
    if (data->GetAbstractArray(k)->GetNumberOfTuples() != surface->GetNumberOfPoints())
    {
      data->RemoveArray(k);
    }
  }
  return data;
}
}

Scene vtkGLTFScene::FromSurface(vtkGLTFDocument& document, vtkPolyData* surface)
{
  std::vector<std::uint32_t> corners;
  for (const vtkSurfaceMeshConversion::FaceTriangle& triangle :
    vtkSurfaceMeshConversion::Triangles(surface))
  {
    for (const vtkIdType corner : triangle.Corners)
    {
      corners.push_back(static_cast<std::uint32_t>(corner));
    }
  }
  const vtkSmartPointer<vtkPointData> data = FittingArrays(surface);
  Json attributes = { { "POSITION",
    document.AddFloats(
      FloatsOf(surface->GetPoints()->GetData(), 3), "VEC3", Use::Vertices, true) } };
  if (data->GetNormals())
  {
    attributes["NORMAL"] =
      document.AddFloats(UnitNormals(data->GetNormals()), "VEC3", Use::Vertices);
  }
  if (data->GetTCoords() && data->GetTCoords()->GetNumberOfComponents() >= 2)
  {
    attributes["TEXCOORD_0"] =
      document.AddFloats(FloatsOf(data->GetTCoords(), 2), "VEC2", Use::Vertices);
  }
  if (vtkDataArray* const colors = ColorsOf(data))
  {
    attributes["COLOR_0"] = document.AddColors(BytesOf(colors));
  }
  const std::size_t indices = document.AddIndices(corners);
  const Json primitive = { { "attributes", attributes }, { "indices", indices }, { "material", 0 },
    { "mode", 4 } };
  document.Root["scene"] = 0;
  document.List("scenes").push_back({ { "nodes", Json::array({ 0 }) } });
  document.List("nodes").push_back({ { "name", "Model" }, { "mesh", 0 } });
  document.List("meshes").push_back(
    { { "name", "Model" }, { "primitives", Json::array({ primitive }) } });
  // As VTK's writer: not shiny, and seen from both sides as in VTK.
  document.List("materials")
    .push_back(
      { { "pbrMetallicRoughness", { { "metallicFactor", 0.0 }, { "roughnessFactor", 1.0 } } },
        { "doubleSided", true } });
  Placement placement;
  placement.Count = static_cast<std::size_t>(surface->GetNumberOfPoints());
  placement.HasNormals = data->GetNormals() != nullptr;
  return { surface, { placement }, placement.HasNormals };
}

Scene vtkGLTFScene::FromDocument(vtkGLTFDocument& document)
{
  Scene scene = Gatherer(document).Gather();
  if (scene.Surface->GetNumberOfPolys() == 0)
  {
    throw std::runtime_error("its scene shows no triangles");
  }
  return scene;
}
