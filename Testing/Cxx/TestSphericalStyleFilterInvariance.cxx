// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What must not change the result: place, scale and orientation of the model, the order of its
/// points and cells, a seam, the number of threads, what the filter did before. In closed form,
/// with details and without, and where an energy is minimized.
#include "FilterTesting.h"

#include <numeric>
#include <random>
#include <set>
#include <utility>

using namespace FilterTesting;

namespace
{
/// Of the diagonal: for points in double, and in single precision, which rounds input and output.
constexpr double Double = 1e-9;
constexpr double Single = 1e-6;
/// Of the diagonal: a grid lies along the axes, and another one is as good only. Largest at
/// Roundness 5, .0706 where details are carried on a minimum of the energy.
constexpr double OtherGrid = 0.075;

struct Setting
{
  const char* name;
  std::function<void(vtkSphericalStyleFilter*)> set;
};

class Invariance
{
public:
  Invariance(Checker& check, vtkPolyData* model, const std::string& name, double roundness,
    const Setting& setting)
    : Check(check)
    , Model(WithPointsOf(model, VTK_DOUBLE))
    , Name(name + ", Roundness " + vtkVariant(roundness).ToString() + ", " + setting.name + ": ")
    , Roundness(roundness)
    , Set(setting.set)
    , Size(Diagonal(model))
  {
    Check.About(Name + "as it is");
    Expected = this->Rounded(Model);
    check(LargestDistance(Model, Expected) > 0.01 * Size, "something should move");
  }

  void Run()
  {
    this->Places();
    this->Scales();
    this->Rotations();
    this->Orders();
    this->Seam();
    this->Threads();
    this->Past();
  }

private:
  void SetUp(vtkSphericalStyleFilter* filter) const
  {
    Set(filter);
    filter->SetRoundness(Roundness);
  }

  bool UsesGrid() const
  {
    vtkNew<vtkSphericalStyleFilter> filter;
    Set(filter);
    const bool byThickness = filter->GetNormalBlend() > 0.0 &&
      filter->GetNormalRadius() == vtkSphericalStyleFilter::OWN_THICKNESS;
    return filter->GetDetailSize() > 0.0 || byThickness;
  }

  Surface Rounded(vtkPolyData* input)
  {
    WatchedFilter filter(input);
    this->SetUp(filter.Get());
    Surface output = filter.Output();
    Check(filter.Errors.empty() && filter.Warnings.empty() && filter->GetConverged(),
      "the filter should converge and say nothing");
    return output;
  }

  /// The result of the model after `there`, brought back by `back`, is the result of the model.
  void Same(const std::string& about, const std::function<Vector(const Vector&)>& there,
    const std::function<Vector(const Vector&)>& back, double tolerance, int type = VTK_DOUBLE)
  {
    Check.About(Name + about);
    const Surface output = this->Rounded(Mapped(Model, there, type));
    Check(output->GetPoints()->GetDataType() == type, "points should keep their number type");
    Check.AtMost(
      LargestDistance(Mapped(output, back), Expected) / Size, tolerance, "difference / diagonal");
  }

  void Places()
  {
    const double far = 1e3 * Size / std::sqrt(3.0);
    const auto move = [](double by) {
      return [by](const Vector& x) { return Vector{ x[0] + by, x[1] - by, x[2] + by }; };
    };
    this->Same("moved by 1e3 diagonals", move(far), move(-far), Double);
    const double near = Size;
    this->Same("moved by a diagonal, single precision", move(near), move(-near), Single, VTK_FLOAT);
  }

  void Scales()
  {
    const auto scale = [](double by) {
      return [by](const Vector& x) { return Vector{ by * x[0], by * x[1], by * x[2] }; };
    };
    for (const double by : { 1e-6, 1e6 })
    {
      const std::string about = "scaled by " + vtkVariant(by).ToString();
      this->Same(about, scale(by), scale(1.0 / by), Double);
      this->Same(about + ", single precision", scale(by), scale(1.0 / by), Single, VTK_FLOAT);
    }
  }

  void Rotations()
  {
    // Two quaternions of no special direction, a quarter turn and a turn about a diagonal.
    for (const auto& q :
      { std::array<double, 4>{ 0.3, 0.8, -0.4, 0.33 },
        std::array<double, 4>{ -0.1, 0.2, 0.9, 0.37 }, std::array<double, 4>{ 1.0, 0.0, 0.0, 1.0 },
        std::array<double, 4>{ 1.0, 1.0, 1.0, 1.0 } })
    {
      double r[3][3];
      vtkMath::QuaternionToMatrix3x3(q.data(), r); // makes q a unit
      double inverse[3][3];
      vtkMath::Transpose3x3(r, inverse);
      const auto turn = [](const double(&by)[3][3])
      {
        return [&by](const Vector& x)
        {
          Vector y;
          vtkMath::Multiply3x3(by, x.data(), y.data());
          return y;
        };
      };
      const bool alongAxes = std::abs(q[0]) == 1.0;
      this->Same(alongAxes ? "rotated, axes to axes" : "rotated", turn(r), turn(inverse),
        alongAxes || !this->UsesGrid() ? Double : OtherGrid);
    }
    const auto mirror = [](const Vector& x) { return Vector{ x[0], -x[1], x[2] }; };
    this->Same("mirrored", mirror, mirror, Double);
  }

  /// The model with the corners of its triangles, `numbers[i]` the new number of point i.
  static Surface Renumbered(vtkPolyData* model, const std::vector<vtkIdType>& numbers,
    const std::vector<std::array<vtkIdType, 3>>& corners)
  {
    std::vector<Vector> points(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      points[numbers[i]] = PointOf(model, static_cast<vtkIdType>(i));
    }
    std::vector<Cell> polygons;
    for (const auto& t : corners)
    {
      polygons.push_back({ numbers[t[0]], numbers[t[1]], numbers[t[2]] });
    }
    return MakeSurface(points, polygons);
  }

  void Orders()
  {
    Check.About(Name + "points, cells and corners in another order");
    std::vector<vtkIdType> numbers(Model->GetNumberOfPoints());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::mt19937 random(7); // the engine is the same everywhere, std::shuffle is not
    const auto shuffle = [&](auto& all)
    {
      for (std::size_t i = all.size(); i > 1; --i)
      {
        std::swap(all[i - 1], all[random() % i]);
      }
    };
    shuffle(numbers);
    auto corners = TriangleCorners(Model);
    shuffle(corners);
    for (auto& t : corners)
    {
      std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    }
    const Surface output = this->Rounded(Renumbered(Model, numbers, corners));
    double largest = 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      const double d =
        Distance(PointOf(output, numbers[i]), PointOf(Expected, static_cast<vtkIdType>(i)));
      largest = d <= largest ? largest : d;
    }
    Check.AtMost(largest / Size, Double, "difference / diagonal");
  }

  /// Points between triangles of the left and of the right half get a twin, as texture seams have.
  void Seam()
  {
    Check.About(Name + "split along a seam");
    const auto n = Model->GetNumberOfPoints();
    const double middle = Model->GetCenter()[0];
    auto corners = TriangleCorners(Model);
    std::set<vtkIdType> left;
    std::map<vtkIdType, vtkIdType> twins;
    std::vector<Vector> points;
    for (vtkIdType i = 0; i < n; ++i)
    {
      points.push_back(PointOf(Model, i));
    }
    std::vector<Cell> polygons;
    for (const bool right : { false, true })
    {
      for (const auto& t : corners)
      {
        const double x =
          (PointOf(Model, t[0])[0] + PointOf(Model, t[1])[0] + PointOf(Model, t[2])[0]) / 3.0;
        if ((x > middle) != right)
        {
          continue;
        }
        Cell cell(t.begin(), t.end());
        for (vtkIdType& id : cell)
        {
          if (!right)
          {
            left.insert(id);
          }
          else if (left.count(id) > 0)
          {
            const auto twin = twins.emplace(id, static_cast<vtkIdType>(points.size()));
            if (twin.second)
            {
              points.push_back(PointOf(Model, id));
            }
            id = twin.first->second;
          }
        }
        polygons.push_back(cell);
      }
    }
    Check(twins.size() > 20, "the test should have a seam");
    const Surface output = this->Rounded(MakeSurface(points, polygons));
    double largest = 0.0;
    for (vtkIdType i = 0; i < n; ++i)
    {
      const double d = Distance(PointOf(output, i), PointOf(Expected, i));
      largest = d <= largest ? largest : d;
    }
    Check.AtMost(largest / Size, Double, "difference / diagonal");
    for (const auto& twin : twins)
    {
      Check(SamePoint(output, twin.first, output, twin.second),
        "point " + Text(twin.first) + " and its twin should stay together to the bit");
    }
  }

  void Threads()
  {
    for (const int threads : { 1, 2, 3, 7 })
    {
      Check.About(Name + Text(threads) + " threads");
      WatchedFilter filter(Model);
      this->SetUp(filter.Get());
      filter->SetNumberOfThreads(threads);
      Check(SamePoints(filter.Output(), Expected), "the result should have the same bits");
    }
  }

  void Past()
  {
    Check.About(Name + "a second run");
    WatchedFilter filter(Model);
    this->SetUp(filter.Get());
    Check(SamePoints(filter.Output(), Expected), "another filter should give the same bits");
    filter->Modified();
    Check(SamePoints(filter.Output(), Expected), "the same filter should give the same bits again");

    Check.About(Name + "after other executions");
    vtkNew<vtkSphericalStyleFilter> first;
    this->SetUp(first);
    const auto back = [&](const std::string& what)
    {
      Check(!SamePoints(filter.Output(), Expected), what + " should change the result");
      filter->SetRoundness(Roundness);
      filter->SetCenterModeToAreaCentroid();
      filter->SetNormalBlend(first->GetNormalBlend());
      filter->SetNormalRadius(first->GetNormalRadius());
      filter->SetKeepSize(first->GetKeepSize());
      filter->SetDetailSize(first->GetDetailSize());
      filter->SetSphericalWeighting(first->GetSphericalWeighting());
      filter->SetEdgeWeightingToHalfEdge();
      filter->SetInputData(Model);
      Check(SamePoints(filter.Output(), Expected), "after " + what + ", the same bits as at first");
    };
    filter->SetRoundness(1.7);
    back("another Roundness");
    filter->SetCenterModeToCustom();
    filter->SetCenter(Model->GetPoint(0));
    back("another center");
    filter->SetNormalBlend(0.5);
    back("a NormalBlend");
    filter->SetNormalBlend(0.8);
    filter->SetNormalRadius(1 - first->GetNormalRadius());
    back("the other NormalRadius");
    filter->SetKeepSizeToExtent();
    back("an extent");
    filter->SetDetailSize(0.03);
    back("a DetailSize");
    filter->SetSphericalWeighting(
      vtkSphericalStyleFilter::COTANGENT - first->GetSphericalWeighting());
    back("the other SphericalWeighting");
    filter->SetEdgeWeightingToFullEdge();
    filter->SetMaximumNumberOfIterations(3);
    filter.Output();
    filter->SetMaximumNumberOfIterations(200);
    filter->SetStopRuleToConverged();
    back("full edges");
    filter->SetEdgeWeightingToIntrinsicDelaunay();
    filter->SetDetailSize(0.05);
    back("intrinsic Delaunay triangles");
    filter->SetInputData(Mapped(Model,
      [](const Vector& x) {
        return Vector{ x[0], 2 * x[1], x[2] };
      }));
    back("other points of the same triangles");
    filter->SetInputData(MakeEllipsoid({ 1.0, 0.8, 2.0 }));
    back("another model");
  }

  Checker& Check;
  Surface Model;
  std::string Name;
  double Roundness;
  std::function<void(vtkSphericalStyleFilter*)> Set;
  double Size;
  Surface Expected;
};
}

int TestSphericalStyleFilterInvariance(int argc, char* argv[])
{
  const Setting settings[] = {
    { "defaults", SetUpDefaults },
    { "without details",
      [](vtkSphericalStyleFilter* filter)
      {
        SetUpDefaults(filter);
        filter->SetDetailSize(0.0);
      } },
    { "without details, radius of the whole model",
      [](vtkSphericalStyleFilter* filter)
      {
        SetUpDefaults(filter);
        filter->SetDetailSize(0.0);
        filter->SetNormalRadiusToWholeModel();
      } },
    { "plain", SetUpEnergy },
    { "energy", SetUpUniform },
    { "energy and details",
      [](vtkSphericalStyleFilter* filter)
      {
        SetUpDefaults(filter);
        filter->SetSphericalWeightingToUniform();
      } },
  };
  Checker check;
  for (const auto& [name, roundness] : { std::pair{ "creature", 0.5 }, { "bottle", 5.0 } })
  {
    const Surface model = ReadModel(argc, argv, (std::string(name) + ".vtp").c_str());
    for (const Setting& setting : settings)
    {
      Invariance(check, model, name, roundness, setting).Run();
    }
  }
  return check.Result();
}
