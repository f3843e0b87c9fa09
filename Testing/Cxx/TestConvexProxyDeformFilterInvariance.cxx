// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What must not change the result: place, scale and orientation of the model, the order of its
/// points, the number of threads, what the filter did before. With a proxy of the user's own all of
/// it holds to rounding; a hull is meshed anew, and that is a matter of yes and no: rounding
/// decides which edge is cut, and only the shape that the proxy stands for stays.
#include "ConvexProxyTesting.h"

#include <numeric>
#include <random>

using namespace FilterTesting;

namespace
{
/// Of the diagonal: for points in double, and in single precision, which rounds input and output.
constexpr double Double = 1e-9;
constexpr double Single = 1e-6;
/// Root mean square, of the diagonal: between two meshes of one hull. Single points may go to
/// another side of it.
constexpr double Meshing = 0.02;

/// The proxy as it was before it was rounded.
Surface AtRest(vtkPolyData* proxy)
{
  auto rest = Surface::New();
  rest->SetPolys(proxy->GetPolys());
  vtkNew<vtkPoints> points;
  points->SetData(PointArray(proxy, "RestPosition"));
  rest->SetPoints(points);
  return rest;
}

double MeanSquare(vtkPolyData* a, vtkPolyData* b)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    const double d = Distance(PointOf(a, i), PointOf(b, i));
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(a->GetNumberOfPoints()));
}

/// Points that differ by more than a tolerance.
vtkIdType CountDifferent(vtkPolyData* a, vtkPolyData* b, double tolerance)
{
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    count += !(Distance(PointOf(a, i), PointOf(b, i)) <= tolerance);
  }
  return count;
}

using Map = std::function<Vector(const Vector&)>;

class Invariance
{
public:
  Invariance(
    Checker& check, vtkPolyData* model, const std::string& name, int projection, int transfer)
    : Check(check)
    , Model(WithPointsOf(model, VTK_DOUBLE))
    , Name(name + ", projection " + Text(projection) + ", transfer " + Text(transfer) + ": ")
    , Projection(projection)
    , Transfer(transfer)
    , Size(Diagonal(model))
  {
    Check.About(Name + "as it is");
    WatchedProxyFilter filter(Model);
    this->Set(filter);
    ByHull = filter.Output();
    Proxy = AtRest(filter.Output(1));
    ByProxy = this->Result(Model, Proxy);
    check(LargestDistance(Model, ByHull) > 0.01 * Size, "something should move");
    check(SamePoints(ByHull, ByProxy), "the hull's mesh as own proxy should give the same bits");
  }

  void Run()
  {
    this->Places();
    this->Scales();
    this->Rotations();
    this->Orders();
    this->Threads();
    this->Past();
  }

private:
  void Set(WatchedProxyFilter& filter) const
  {
    filter->SetProjection(Projection);
    filter->SetTransfer(Transfer);
    filter->SetBlend(0.3);
  }

  Surface Result(vtkPolyData* input, vtkPolyData* proxy, int precision = 2)
  {
    WatchedProxyFilter filter(input);
    this->Set(filter);
    filter->SetOutputPointsPrecision(precision);
    if (proxy)
    {
      filter->SetProxyData(proxy);
    }
    Surface output = filter.Output();
    Check(filter.Errors.empty(), "no error should be reported" + Joined(filter.Errors));
    return output;
  }

  /// The result of the model after `there`, brought back by `back`, is the result of the model.
  void Same(const std::string& about, const Map& there, const Map& back, double tolerance,
    int type = VTK_DOUBLE)
  {
    Check.About(Name + about);
    const Surface output = this->Result(Mapped(Model, there, type), Mapped(Proxy, there, type));
    Check(output->GetPoints()->GetDataType() == type, "points should keep their number type");
    const Surface result = Mapped(output, back);
    if (Projection == 2)
    {
      // Its reach is a share of the diagonal of the bounds, which turn with nothing.
      const vtkIdType other = CountDifferent(result, ByProxy, tolerance * Size);
      std::cout << Name << about << ", own proxy: " << other << " points have another foot\n";
      Check(other <= Model->GetNumberOfPoints() / 200,
        "own proxy: " + Text(other) + " points have another foot");
    }
    else
    {
      Check.AtMost(
        LargestDistance(result, ByProxy) / Size, tolerance, "own proxy: difference / diagonal");
    }
    if (type == VTK_DOUBLE && Projection == 0)
    {
      const Surface anew = Mapped(this->Result(Mapped(Model, there), nullptr), back);
      const double difference = MeanSquare(anew, ByHull) / Size;
      std::cout << Name << about << ", hull meshed anew: " << difference << " diagonals, at most "
                << LargestDistance(anew, ByHull) / Size << "\n";
      Check.AtMost(difference, Meshing, "hull: difference / diagonal");
    }
  }

  void Places()
  {
    const double far = 1e3 * Size / std::sqrt(3.0);
    const auto move = [](double by) {
      return [by](const Vector& x) { return Vector{ x[0] + by, x[1] - by, x[2] + by }; };
    };
    this->Same("moved by 1e3 diagonals", move(far), move(-far), Double);
    if (Projection == 0)
    {
      this->Same(
        "moved by a diagonal, single precision", move(Size), move(-Size), Single, VTK_FLOAT);
    }
  }

  void Scales()
  {
    const auto scale = [](double by) {
      return [by](const Vector& x) { return Vector{ by * x[0], by * x[1], by * x[2] }; };
    };
    for (const double by : { 1e-6, 1e6, 0x1p-20, 0x1p20 })
    {
      this->Same("scaled by " + vtkVariant(by).ToString(), scale(by), scale(1.0 / by), Double);
    }
  }

  void Rotations()
  {
    // Quaternions of no special direction.
    for (const auto& q : { std::array<double, 4>{ 0.3, 0.8, -0.4, 0.33 },
           std::array<double, 4>{ -0.1, 0.2, 0.9, 0.37 } })
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
      this->Same("rotated", turn(r), turn(inverse), Double);
    }
  }

  /// Points in another order, triangles with them.
  void Orders()
  {
    Check.About(Name + "points in another order");
    std::vector<vtkIdType> numbers(Model->GetNumberOfPoints());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::mt19937 random(7); // the engine is the same everywhere, std::shuffle is not
    for (std::size_t i = numbers.size(); i > 1; --i)
    {
      std::swap(numbers[i - 1], numbers[random() % i]);
    }
    std::vector<Vector> points(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      points[numbers[i]] = PointOf(Model, static_cast<vtkIdType>(i));
    }
    std::vector<Cell> polygons;
    for (const auto& t : TriangleCorners(Model))
    {
      polygons.push_back({ numbers[t[0]], numbers[t[1]], numbers[t[2]] });
    }
    const Surface other = MakeSurface(points, polygons);
    // The hull does not know of an order either: it is that of a set of points.
    for (vtkPolyData* proxy : { Proxy.Get(), static_cast<vtkPolyData*>(nullptr) })
    {
      const Surface output = this->Result(other, proxy);
      vtkIdType different = 0;
      for (std::size_t i = 0; i < numbers.size(); ++i)
      {
        different += !SamePoint(output, numbers[i], ByProxy, static_cast<vtkIdType>(i));
      }
      Check(different == 0,
        std::string(proxy ? "own proxy: " : "hull: ") + Text(different) +
          " points should have the same bits");
    }
  }

  void Threads()
  {
    for (const int threads : { 1, 2, 3, 7 })
    {
      Check.About(Name + Text(threads) + " threads");
      WatchedProxyFilter filter(Model);
      this->Set(filter);
      filter->SetNumberOfThreads(threads);
      Check(SamePoints(filter.Output(), ByHull), "the result should have the same bits");
    }
  }

  void Past()
  {
    Check.About(Name + "a second run");
    WatchedProxyFilter filter(Model);
    this->Set(filter);
    Check(SamePoints(filter.Output(), ByHull), "another filter should give the same bits");
    filter->Modified();
    Check(SamePoints(filter.Output(), ByHull), "the same filter should give the same bits again");

    Check.About(Name + "after other executions");
    const auto back = [&](const std::string& what, const std::function<void()>& restore)
    {
      Check(!SamePoints(filter.Output(), ByHull), what + " should change the result");
      restore();
      Check(SamePoints(filter.Output(), ByHull), "after " + what + ", the same bits as at first");
    };
    filter->SetRoundness(1.7);
    back("another Roundness", [&] { filter->SetRoundness(5.0); });
    filter->SetNumberOfProxyPoints(200);
    back("another number of points", [&] { filter->SetNumberOfProxyPoints(300); });
    filter->SetProxyMesherToBallPivoting();
    back("another mesher", [&] { filter->SetProxyMesherToIsotropicRemeshing(); });
    filter->SetCenterModeToCustom();
    filter->SetCenter(Model->GetPoint(0));
    back("another center", [&] { filter->SetCenterModeToAreaCentroid(); });
    filter->SetProjection(Projection == 2 ? 0 : 2);
    back("another projection", [&] { filter->SetProjection(Projection); });
    filter->SetAxisGain(1.0, 2.0, 1.0);
    back("a gain", [&] { filter->SetAxisGain(1.0, 1.0, 1.0); });
    filter->SetProxyData(MakeEllipsoid({ 2.0, 2.0, 2.0 }));
    back("an own proxy", [&] { filter->SetProxyConnection(nullptr); });
    filter->SetSelectionData(MakeSelection({ 0, 1, 2, 3, 4, 5, 6 }, vtkSelectionNode::POINT));
    back("a selection", [&] { filter->SetSelectionConnection(nullptr); });
    filter->SetInputData(Mapped(Model,
      [](const Vector& x) {
        return Vector{ x[0], 2 * x[1], x[2] };
      }));
    back("other points", [&] { filter->SetInputData(Model); });
  }

  Checker& Check;
  Surface Model;
  std::string Name;
  int Projection;
  int Transfer;
  double Size;
  Surface Proxy;
  Surface ByProxy;
  Surface ByHull;
};

void Seeds(Checker& check, vtkPolyData* model)
{
  for (const int mesher : { 0, 1, 2, 3 })
  {
    check.About("seeds of mesher " + Text(mesher));
    const auto result = [&](int seed)
    {
      WatchedProxyFilter filter(model);
      filter->SetProxyMesher(mesher);
      filter->SetSeed(seed);
      Surface output = filter.Output();
      return output;
    };
    const Surface first = result(1);
    check(SamePoints(first, result(1)), "the same seed should give the same bits");
    check(SamePoints(first, result(2)) == (mesher == 0 || mesher == 3),
      "another seed should give other samples, where there are some");
  }
}
}

int TestConvexProxyDeformFilterInvariance(int argc, char* argv[])
{
  Checker check;
  for (const char* name : { "creature", "stone-house", "bottle" })
  {
    const Surface model = ReadModel(argc, argv, (std::string(name) + ".vtp").c_str());
    Invariance(check, model, name, 0, 0).Run();
    Invariance(check, model, name, 1, 1).Run();
  }
  Invariance(check, ReadModel(argc, argv, "creature.vtp"), "creature", 2, 0).Run();
  Seeds(check, ReadModel(argc, argv, "bottle.vtp"));
  return check.Result();
}
