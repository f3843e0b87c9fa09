// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGLTFTargets.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

using Json = vtkGLTFDocument::Json;
using Use = vtkGLTFDocument::Use;
using vtkGLTFScene::Placement;
using vtkRoundnessTargets::Rows;
using vtkRoundnessTargets::Target;
using vtkRoundnessTargets::Targets;

namespace
{
constexpr double AnimationSeconds = 2.0;

std::string MeshName(std::size_t mesh)
{
  return "mesh " + std::to_string(mesh);
}

/// Two digits behind the point, or three of what is smaller.
std::string Short(double value)
{
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

/// Between two targets the weight passes from one to the other; before the first from the model.
std::vector<float> WeightsAt(const Targets& targets, double slider)
{
  std::vector<float> weights(targets.All.size(), 0.0F);
  if (targets.Linear)
  {
    weights[0] = static_cast<float>(slider);
    return weights;
  }
  double from = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k)
  {
    const double to = targets.All[k].Slider;
    if (slider <= to || k + 1 == weights.size())
    {
      const double share = std::clamp((slider - from) / (to - from), 0.0, 1.0);
      weights[k] = static_cast<float>(share);
      if (k > 0)
      {
        weights[k - 1] = static_cast<float>(1.0 - share);
      }
      break;
    }
    from = to;
  }
  return weights;
}

/// A target brought from the scene to the points of a primitive.
std::vector<float> Moves(const Target& target, const Placement& placement)
{
  std::vector<float> values;
  values.reserve(3 * placement.Count);
  for (std::size_t i = 0; i < placement.Count; ++i)
  {
    const auto row = static_cast<Eigen::Index>(placement.First + i);
    const Eigen::Matrix3d& linear = placement.LinearOf(i);
    Eigen::Vector3d move = Eigen::Vector3d::Zero(); // where a bone has shrunk its points to one
    if (!vtkGLTFScene::IsFlat(linear))
    {
      move = linear.inverse() * target.Moves.row(row).transpose().cast<double>();
    }
    for (int c = 0; c < 3; ++c)
    {
      values.push_back(static_cast<float>(move(c)));
    }
  }
  return values;
}

/// @param model  normals of the model in the scene
std::vector<float> Turns(const Target& target, const Rows& model, const Placement& placement)
{
  std::vector<float> values;
  values.reserve(3 * placement.Count);
  for (std::size_t i = 0; i < placement.Count; ++i)
  {
    const auto row = static_cast<Eigen::Index>(placement.First + i);
    const Eigen::Matrix3d back = placement.LinearOf(i).transpose();   // of normals
    const double length = (back * model.row(row).transpose()).norm(); // in the file it is 1
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    if (length > 0.0)
    {
      turn = back * target.Normals.row(row).transpose().cast<double>() / length;
    }
    for (int c = 0; c < 3; ++c)
    {
      values.push_back(static_cast<float>(turn(c)));
    }
  }
  return values;
}

/// How many targets the primitives of a mesh have.
std::size_t TargetsOf(const Json& mesh, const std::string& owner)
{
  std::size_t count = vtkGLTFDocument::None;
  for (const Json& primitive : mesh.at("primitives"))
  {
    const auto found = primitive.find("targets");
    const std::size_t own = found != primitive.end() && found->is_array() ? found->size() : 0;
    if (count != vtkGLTFDocument::None && own != count)
    {
      throw std::runtime_error(owner + ": its primitives have different numbers of morph targets");
    }
    count = own;
  }
  return count == vtkGLTFDocument::None ? 0 : count;
}

/// An array of this size, with values of its own where it is shorter.
void Fill(Json& list, std::size_t size, const Json& with)
{
  if (!list.is_array())
  {
    list = Json::array();
  }
  while (list.size() < size)
  {
    list.push_back(with);
  }
}

void Append(Json& list, const std::vector<float>& weights)
{
  for (const float weight : weights)
  {
    list.push_back(static_cast<double>(weight));
  }
}

/// Names and mapping, for programs that make the slider.
Json Description(const Targets& targets, std::size_t first)
{
  const char* const mapping = "w / (1 - w) / sqrt(3)";
  Json json = { { "slider", "Roundness" }, { "firstTarget", first },
    { "numberOfTargets", targets.All.size() }, { "roundness", mapping } };
  if (targets.Linear)
  {
    json["w"] = "the weight of the target, 0 to 1";
    return json;
  }
  json["w"] = "between two places the weight passes from one target to the next; at 0 is the model";
  json["places"] = Json::array();
  for (const Target& target : targets.All)
  {
    json["places"].push_back(target.Slider);
  }
  json["animation"] = "Roundness";
  json["largestError"] = targets.Error;
  json["largestJump"] = targets.Jump;
  return json;
}

void Describe(Json& mesh, const Targets& targets, std::size_t first)
{
  Json& extras = mesh["extras"];
  if (extras.is_null())
  {
    extras = Json::object();
  }
  if (!extras.is_object())
  {
    return; // somebody else's words
  }
  Json& names = extras["targetNames"];
  for (std::size_t k = names.is_array() ? names.size() : 0; k < first; ++k)
  {
    Fill(names, k + 1, "Target " + std::to_string(k + 1));
  }
  Fill(names, first, "");
  for (const Target& target : targets.All)
  {
    names.push_back(targets.Linear
        ? "Roundness"
        : "Roundness " + Short(vtkRoundnessTargets::RoundnessOf(target.Slider)));
  }
  extras["sphericalStyle"] = Description(targets, first);
}

/// Adds what is new to animations of weights: at every key the same.
class AnimatedWeights
{
public:
  AnimatedWeights(vtkGLTFDocument& document, const std::vector<float>& weights)
    : Document(document)
    , Weights(weights)
  {
  }

  /// @param meshOf  the meshes of nodes that have new targets @param before  targets of meshes
  void Extend(const std::map<std::size_t, std::size_t>& meshOf,
    const std::map<std::size_t, std::size_t>& before)
  {
    const auto animations = this->Document.Root.find("animations");
    const std::size_t count = animations == this->Document.Root.end() ? 0 : animations->size();
    for (std::size_t a = 0; a < count; ++a)
    {
      const std::string owner = "animation " + std::to_string(a);
      std::map<std::size_t, std::size_t> samplers; // and the targets that they had
      const Json animation = this->Document.Root["animations"][a];
      for (const Json& channel : vtkGLTFDocument::Objects(animation, "channels", owner))
      {
        const auto target = channel.find("target");
        if (target != channel.end() && vtkGLTFDocument::Text(*target, "path") == "weights")
        {
          const auto mesh =
            meshOf.find(vtkGLTFDocument::Number(*target, "node", vtkGLTFDocument::None, owner));
          if (mesh != meshOf.end())
          {
            samplers[vtkGLTFDocument::Index(channel, "sampler", owner)] = before.at(mesh->second);
          }
        }
      }
      for (const auto& [sampler, targets] : samplers)
      {
        this->ExtendSampler(a, sampler, targets, owner);
      }
    }
  }

private:
  void ExtendSampler(
    std::size_t animation, std::size_t sampler, std::size_t targets, const std::string& owner)
  {
    const Json samplers =
      vtkGLTFDocument::Objects(this->Document.Root["animations"][animation], "samplers", owner);
    if (sampler >= samplers.size())
    {
      throw std::runtime_error(owner + ": has no sampler " + std::to_string(sampler));
    }
    const Json& json = samplers[sampler];
    const std::vector<double> old =
      this->Document.Values(vtkGLTFDocument::Index(json, "output", owner), "SCALAR");
    const bool cubic = vtkGLTFDocument::Text(json, "interpolation") == "CUBICSPLINE";
    if (targets == 0 || old.size() % targets != 0)
    {
      throw std::runtime_error(
        owner + ": its weights are not those of " + std::to_string(targets) + " targets");
    }
    std::vector<float> values;
    for (std::size_t key = 0; key < old.size() / targets; ++key)
    {
      for (std::size_t k = 0; k < targets; ++k)
      {
        values.push_back(static_cast<float>(old[key * targets + k]));
      }
      const bool isTangent = cubic && key % 3 != 1;
      for (const float weight : this->Weights)
      {
        values.push_back(isTangent ? 0.0F : weight);
      }
    }
    const std::size_t output = this->Document.AddFloats(values, "SCALAR", Use::Animation);
    this->Document.Root["animations"][animation]["samplers"][sampler]["output"] = output;
  }

  vtkGLTFDocument& Document;
  const std::vector<float>& Weights;
};

/// Moves the slider from the model to the last target.
void AddAnimation(vtkGLTFDocument& document, const Targets& targets,
  const std::map<std::size_t, std::size_t>& meshOf,
  const std::map<std::size_t, std::size_t>& before)
{
  std::vector<float> times = { 0.0F };
  for (const Target& target : targets.All)
  {
    times.push_back(
      static_cast<float>(AnimationSeconds * target.Slider / targets.All.back().Slider));
  }
  const std::size_t input = document.AddFloats(times, "SCALAR", Use::Animation, true);
  Json channels = Json::array(), samplers = Json::array();
  for (const auto& [node, mesh] : meshOf)
  {
    const Json& json = document.Root["meshes"][mesh];
    std::vector<float> others; // of targets that there were, as they are
    for (std::size_t k = 0; k < before.at(mesh); ++k)
    {
      const Json& value = json.at("weights").at(k);
      others.push_back(value.is_number() ? value.get<float>() : 0.0F);
    }
    std::vector<float> values;
    for (std::size_t key = 0; key < times.size(); ++key)
    {
      values.insert(values.end(), others.begin(), others.end());
      for (std::size_t k = 0; k < targets.All.size(); ++k)
      {
        values.push_back(k + 1 == key ? 1.0F : 0.0F);
      }
    }
    const std::size_t output = document.AddFloats(values, "SCALAR", Use::Animation);
    channels.push_back({ { "sampler", samplers.size() },
      { "target", { { "node", node }, { "path", "weights" } } } });
    samplers.push_back({ { "input", input }, { "interpolation", "LINEAR" }, { "output", output } });
  }
  document.List("animations")
    .push_back({ { "name", "Roundness" }, { "channels", channels }, { "samplers", samplers } });
}
} // namespace

void vtkGLTFTargets::Add(vtkGLTFDocument& document, const vtkGLTFScene::Scene& scene,
  const Targets& targets, double slider)
{
  const std::vector<float> weights = WeightsAt(targets, slider);
  std::map<std::size_t, std::size_t> meshOf; // of a node
  std::map<std::size_t, std::size_t> before; // targets of a mesh
  for (const Placement& placement : scene.Placements)
  {
    if (meshOf.emplace(placement.Node, placement.Mesh).second)
    {
      before[placement.Mesh] =
        TargetsOf(document.Root["meshes"][placement.Mesh], MeshName(placement.Mesh));
    }
  }
  // Also where another scene shows them.
  std::size_t node = 0;
  for (const Json& json : document.Root["nodes"])
  {
    const std::size_t mesh =
      vtkGLTFDocument::Number(json, "mesh", vtkGLTFDocument::None, "node " + std::to_string(node));
    if (before.count(mesh) > 0)
    {
      meshOf.emplace(node, mesh);
    }
    ++node;
  }
  const Rows normals = vtkRoundnessTargets::RowsOf(targets.Model->GetPointData()->GetNormals());
  for (const Placement& placement : scene.Placements)
  {
    for (const Target& target : targets.All)
    {
      Json json = { { "POSITION",
        document.AddFloats(Moves(target, placement), "VEC3", Use::Vertices, true) } };
      if (placement.HasNormals && target.Normals.rows() > 0)
      {
        json["NORMAL"] =
          document.AddFloats(Turns(target, normals, placement), "VEC3", Use::Vertices);
      }
      Json& list =
        document.Root["meshes"][placement.Mesh]["primitives"][placement.Primitive]["targets"];
      Fill(list, 0, Json());
      list.push_back(std::move(json));
    }
  }
  AnimatedWeights(document, weights).Extend(meshOf, before);
  for (const auto& [mesh, own] : before)
  {
    Json& json = document.Root["meshes"][mesh];
    Fill(json["weights"], own, 0.0);
    Append(json["weights"], weights);
    Describe(json, targets, own);
  }
  for (const auto& [node, mesh] : meshOf)
  {
    Json& shown = document.Root["nodes"][node];
    if (shown.contains("weights"))
    {
      Fill(shown["weights"], before.at(mesh), 0.0);
      Append(shown["weights"], weights);
    }
  }
  if (!targets.Linear)
  {
    AddAnimation(document, targets, meshOf, before);
  }
}
