// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceParts.h"

#include "DisjointSets.h"
#include "LimbThickness.h"
#include "Parallel.h"
#include "ShortestPaths.h"
#include "SurfaceGrid.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr double PartSize = 0.03;
constexpr double ConcavityWeight = 6.0;
constexpr double LeastConductivity = 0.02;
constexpr double PairReachOfParts = 2.3; // in sub-cells
constexpr double SubCellsOfSpacing = 3.0;
constexpr double LeastAgreementOfPairs = -0.2;
constexpr double ConcavityPower = 1.5;
constexpr double ThicknessWeight = 0.35;
constexpr double LongestBorder = 0.9;
constexpr double WorstCut = 0.25;
constexpr double HealedBorder = 1.5; // of PartSize
constexpr double MassOfFields = 0.1; // 1 / length^2, well below the smallest lambda that matters
constexpr int Iterations = 6;
constexpr int SmoothFields = 9;
constexpr int Sources = 12;
constexpr double SlopeStep = 0.25; // of a cell
constexpr double ThicknessWithoutRadius = 0.5;
constexpr double NoCut = std::numeric_limits<double>::infinity();
constexpr int NotThere = -1;
constexpr double Pi = 3.14159265358979323846;

/// Pairs of near samples, with w_kl.
struct SamplePairs
{
  std::vector<int> first; // of each sample, and one past the last
  std::vector<int> others;
  std::vector<double> weights;
};

/// Where a level set of a field is a piece worth cutting off.
struct Cut
{
  double q = NoCut;
  int field = NotThere;
  int direction = 1; // whether the piece is below (1) or above (-1) the level
  double level = 0.0;
  int sample = NotThere; // one of the piece
};

using Samples = std::vector<int>;

/// A part, and how it is best cut.
struct OpenPart
{
  Samples samples;
  double area = 0.0;
  double q = NoCut;
  std::vector<Samples> pieces;
};

class PartFinder
{
public:
  PartFinder(
    const Points& p, const Triangles& f, const PartsOptions& options, const Callback& callback);
  SurfacePartsResult Find();

private:
  Eigen::Index Count() const { return this->Weights.size(); }
  void MakeConductivity(const Points& B, const Triangles& F);
  void MakePairs();
  double AreaOf(const Samples& samples) const;
  /// Connected pieces of samples with the same mark; samples with NotThere are none.
  std::vector<Samples> Pieces(const Samples& samples, const std::vector<int>& marks) const;
  std::vector<OpenPart> LoosePieces();
  /// @param search  whether it may be cut
  OpenPart Open(Samples samples, bool search);
  bool AreEnough(std::size_t parts) const;
  Fields FieldsOf(const Samples& part) const;
  Fields SourceFields(
    const SurfaceGrid& grid, const Fields& smooth, const Eigen::VectorXd& eigenvalues) const;
  /// What the sweeps over a part have in common.
  struct Swept
  {
    const Samples& samples;
    double area = 0.0;
    double logThickness = 0.0;     // integral
    std::vector<char> inside;      // of all samples
    std::vector<double> conducted; // of all pairs, w_kl kappa_kl
  };
  Swept PrepareSweeps(const Samples& part, double area) const;
  std::array<Cut, 2> Sweep(const Swept& part, const Fields& u, int field) const;
  Cut Sweep(const Swept& part, const Samples& order, const std::vector<double>& levels) const;
  std::vector<Samples> CutOff(const Samples& part, const Fields& u, const Cut& cut) const;
  void Heal(const std::vector<Samples>& pieces);
  SurfacePartsResult Result(const std::vector<OpenPart>& parts);

  const Points& P;
  PartsOptions Options;
  const Callback& Asked;
  int Searches = 0;
  SurfaceGrid Grid;
  Eigen::VectorXd Weights;
  Points Normals; // of samples
  Eigen::VectorXd Conductivity;
  Eigen::VectorXd LogThickness;
  SamplePairs Pairs;
  double Area = 0.0;
  std::vector<std::pair<int, int>> Strays; // samples of small loose pieces, and the nearest other
};

PartFinder::PartFinder(
  const Points& p, const Triangles& f, const PartsOptions& options, const Callback& callback)
  : P(p)
  , Options(options)
  , Asked(callback)
  , Grid(p, f, PartSize, options.threads)
  , Weights(Grid.GetWeights())
  , Area(Weights.sum())
{
  const int threads = options.threads;
  this->Grid.FactorAlong(threads);
  const Points B =
    this->Grid.AtPoints(this->Grid.SmoothTwice(this->Grid.GetPlaces(), threads), p, threads);
  this->MakeConductivity(B, f);
  this->Grid.ForgetPoints();
  this->MakePairs();
}

/// n_k, kappa_k and log rho_k.
void PartFinder::MakeConductivity(const Points& B, const Triangles& F)
{
  const int threads = this->Options.threads;
  const Eigen::VectorXd rho = LimbThickness(this->P, B, F, ThicknessWithoutRadius, threads);
  this->LogThickness = this->Grid.Means(rho, threads).col(0).array().log();
  Fields normals = this->Grid.AreaVectorsUnder(this->Grid.Gradients(B, threads), threads);
  normals = this->Weights.cwiseInverse().asDiagonal() * normals;
  const Fields coefficients = this->Grid.Smooth(normals, threads);
  normals = this->Grid.AtSamples(coefficients, threads);
  std::array<Fields, 3> slopes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d step = SlopeStep * Eigen::Vector3d::Unit(axis);
    slopes[axis] = (this->Grid.AtSamples(coefficients, threads, step) -
                     this->Grid.AtSamples(coefficients, threads, -step)) /
      (2.0 * SlopeStep * this->Grid.GetSpacing());
  }
  this->Normals = Points::Zero(this->Count(), 3);
  this->Conductivity = Eigen::VectorXd::Ones(this->Count());
  for (Eigen::Index k = 0; k < this->Count(); ++k)
  {
    const double length = normals.row(k).norm();
    if (!(length > 0.0))
    {
      continue;
    }
    const Eigen::Vector3d n = normals.row(k).transpose() / length;
    this->Normals.row(k) = n;
    Eigen::Matrix3d G;
    G << slopes[0].row(k).transpose(), slopes[1].row(k).transpose(), slopes[2].row(k).transpose();
    const Eigen::Matrix3d tangent = Eigen::Matrix3d::Identity() - n * n.transpose();
    const Eigen::Matrix3d curvature = tangent * (G + G.transpose()) * tangent * (0.5 / length);
    const double concave =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(curvature, Eigen::EigenvaluesOnly)
        .eigenvalues()(0);
    const double thickness = std::exp(this->LogThickness(k));
    this->Conductivity(k) =
      std::max(LeastConductivity, std::exp(ConcavityWeight * thickness * std::min(0.0, concave)));
  }
}

void PartFinder::MakePairs()
{
  const double subCell = this->Grid.GetSpacing() / SubCellsOfSpacing;
  const double reach = PairReachOfParts * subCell;
  const double perProduct = 1.5 / (reach * reach * reach);
  const int cells = static_cast<int>(std::ceil(PairReachOfParts));
  using Cell = std::array<std::int64_t, 3>;
  const auto key = [](const Cell& c)
  {
    constexpr std::int64_t Width = std::int64_t{ 1 } << 20;
    return c[0] + Width * (c[1] + Width * c[2]); // cells are at most Width / 2 from the middle
  };
  const int m = static_cast<int>(this->Count());
  const Points& places = this->Grid.GetPlaces();
  std::vector<Cell> cellOf(m);
  std::unordered_map<std::int64_t, int> sampleAt;
  for (int k = 0; k < m; ++k)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      cellOf[k][axis] = static_cast<std::int64_t>(std::floor(places(k, axis) / subCell + 0.5));
    }
    sampleAt[key(cellOf[k])] = k;
  }
  this->Pairs.first.assign(1, 0);
  for (int k = 0; k < m; ++k)
  {
    for (int x = -cells; x <= cells; ++x)
    {
      for (int y = -cells; y <= cells; ++y)
      {
        for (int z = -cells; z <= cells; ++z)
        {
          const auto found =
            sampleAt.find(key({ cellOf[k][0] + x, cellOf[k][1] + y, cellOf[k][2] + z }));
          if (found == sampleAt.end() || found->second == k)
          {
            continue;
          }
          const int l = found->second;
          if ((places.row(k) - places.row(l)).norm() < reach &&
            this->Normals.row(k).dot(this->Normals.row(l)) > LeastAgreementOfPairs)
          {
            this->Pairs.others.push_back(l);
            this->Pairs.weights.push_back(perProduct * this->Weights(k) * this->Weights(l));
          }
        }
      }
    }
    this->Pairs.first.push_back(static_cast<int>(this->Pairs.others.size()));
  }
}

double PartFinder::AreaOf(const Samples& samples) const
{
  double area = 0.0;
  for (const int k : samples)
  {
    area += this->Weights(k);
  }
  return area;
}

std::vector<Samples> PartFinder::Pieces(const Samples& samples, const std::vector<int>& marks) const
{
  std::vector<char> open(marks.size(), 0);
  for (const int k : samples)
  {
    open[k] = marks[k] != NotThere ? 1 : 0;
  }
  std::vector<Samples> pieces;
  for (const int start : samples)
  {
    if (!open[start])
    {
      continue;
    }
    Samples piece = { start };
    open[start] = 0;
    for (std::size_t i = 0; i < piece.size(); ++i)
    {
      const int k = piece[i];
      for (int e = this->Pairs.first[k]; e < this->Pairs.first[k + 1]; ++e)
      {
        const int l = this->Pairs.others[e];
        if (open[l] && marks[l] == marks[k])
        {
          open[l] = 0;
          piece.push_back(l);
        }
      }
    }
    std::sort(piece.begin(), piece.end());
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// The fields to cut along: nine smooth ones, then those of the sources. samples x 21; not of the
/// part 0.
Fields PartFinder::FieldsOf(const Samples& part) const
{
  const int threads = this->Options.threads;
  SurfaceGrid grid = this->Grid.At(part);
  grid.FactorConduction(this->Conductivity(part), MassOfFields, threads);
  const Eigen::VectorXd& mass = grid.GetWeights();
  const double area = mass.sum();
  const Points& x = grid.GetPlaces();
  Fields u(x.rows(), SmoothFields);
  u << x, x.cwiseProduct(x), x.col(0).cwiseProduct(x.col(1)), x.col(1).cwiseProduct(x.col(2)),
    x.col(2).cwiseProduct(x.col(0));
  const auto center = [&](Fields& fields)
  {
    const Eigen::RowVectorXd mean = (mass.transpose() * fields) / area;
    fields.rowwise() -= mean;
  };
  Eigen::VectorXd eigenvalues;
  for (int i = 0; i < Iterations; ++i)
  {
    center(u);
    const Eigen::VectorXd lengths =
      (mass.transpose() * u.cwiseAbs2()).cwiseSqrt().cwiseMax(1e-300).transpose();
    u = u * lengths.cwiseInverse().asDiagonal();
    const Fields solved = grid.AtSamples(grid.Smooth(u, threads), threads);
    // In the space of the solutions y = A^-1 M u: y^T A y = y^T M u, and y^T M y.
    Eigen::MatrixXd A = solved.transpose() * mass.asDiagonal() * u;
    A = 0.5 * (A + A.transpose()).eval();
    A.diagonal().array() += 1e-12 * A.trace();
    Fields y = solved;
    center(y);
    const Eigen::MatrixXd M = y.transpose() * mass.asDiagonal() * y;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(M, A);
    eigenvalues = ritz.eigenvalues().reverse().cwiseMax(1e-300).cwiseInverse();
    u = y * ritz.eigenvectors().rowwise().reverse();
  }
  const Fields sources = this->SourceFields(grid, u, eigenvalues);
  Fields all = Fields::Zero(this->Count(), SmoothFields + Sources);
  for (std::size_t i = 0; i < part.size(); ++i)
  {
    const auto row = static_cast<Eigen::Index>(i);
    all.row(part[i]) << u.row(row), sources.row(row);
  }
  return all;
}

Fields PartFinder::SourceFields(
  const SurfaceGrid& grid, const Fields& smooth, const Eigen::VectorXd& eigenvalues) const
{
  const Fields at = smooth * eigenvalues.cwiseSqrt().cwiseInverse().asDiagonal();
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(at.rows(), NoCut);
  Eigen::Index source = 0;
  at.rowwise().squaredNorm().maxCoeff(&source);
  Fields sources = Fields::Zero(at.rows(), Sources);
  for (int s = 0; s < Sources; ++s)
  {
    sources(source, s) = 1.0 / grid.GetWeights()(source);
    distance = distance.cwiseMin((at.rowwise() - at.row(source)).rowwise().squaredNorm());
    distance.maxCoeff(&source);
  }
  const int threads = this->Options.threads;
  return grid.AtSamples(grid.Smooth(sources, threads), threads);
}

/// Sets of samples that grow together while a level sweeps over them, with what they have.
class GrowingPieces
{
public:
  explicit GrowingPieces(std::size_t samples)
    : Up(samples, NotThere)
    , Sums(samples)
  {
  }

  struct Sum
  {
    double area = 0.0;
    double length = 0.0;    // of the border
    double conducted = 0.0; // the same, times kappa
    double thickness = 0.0; // area times log rho

    Sum& operator+=(const Sum& more)
    {
      this->area += more.area;
      this->length += more.length;
      this->conducted += more.conducted;
      this->thickness += more.thickness;
      return *this;
    }
  };

  bool Has(int k) const { return this->Up[k] != NotThere; }
  void Add(int k, const Sum& sum)
  {
    this->Up[k] = k;
    this->Sums[k] = sum;
  }
  /// The piece of l becomes one with that of the root k.
  void Join(int k, int l)
  {
    const int other = RootOf(this->Up, l);
    if (other != k)
    {
      this->Sums[k] += this->Sums[other];
      this->Up[other] = k;
    }
  }
  Sum& operator[](int root) { return this->Sums[root]; }

private:
  std::vector<int> Up;
  std::vector<Sum> Sums;
};

PartFinder::Swept PartFinder::PrepareSweeps(const Samples& part, double area) const
{
  Swept swept = { part, area, 0.0, std::vector<char>(this->Count(), 0),
    std::vector<double>(this->Pairs.weights.size()) };
  for (const int k : part)
  {
    swept.inside[k] = 1;
    swept.logThickness += this->Weights(k) * this->LogThickness(k);
    for (int e = this->Pairs.first[k]; e < this->Pairs.first[k + 1]; ++e)
    {
      swept.conducted[e] = this->Pairs.weights[e] *
        std::sqrt(this->Conductivity(k) * this->Conductivity(this->Pairs.others[e]));
    }
  }
  return swept;
}

/// The best pieces below and above a level of u.
std::array<Cut, 2> PartFinder::Sweep(const Swept& part, const Fields& u, int field) const
{
  std::vector<double> levels(this->Count());
  for (const int k : part.samples)
  {
    levels[k] = u(k, field);
  }
  Samples order = part.samples;
  std::sort(order.begin(), order.end(),
    [&](int k, int l) { return levels[k] < levels[l] || (levels[k] == levels[l] && k < l); });
  std::array<Cut, 2> cuts;
  cuts[0] = this->Sweep(part, order, levels);
  std::reverse(order.begin(), order.end());
  cuts[1] = this->Sweep(part, order, levels);
  cuts[1].direction = -1;
  for (Cut& cut : cuts)
  {
    cut.field = field;
  }
  return cuts;
}

/// The best piece of those samples that have come up to some place of the order.
Cut PartFinder::Sweep(
  const Swept& part, const Samples& order, const std::vector<double>& levels) const
{
  GrowingPieces pieces(levels.size());
  Cut best;
  for (const int k : order)
  {
    GrowingPieces::Sum own = { this->Weights(k), 0.0, 0.0,
      this->Weights(k) * this->LogThickness(k) };
    pieces.Add(k, {});
    for (int e = this->Pairs.first[k]; e < this->Pairs.first[k + 1]; ++e)
    {
      const int l = this->Pairs.others[e];
      if (!part.inside[l])
      {
        continue;
      }
      const bool joins = pieces.Has(l);
      if (joins)
      {
        pieces.Join(k, l);
      }
      own.length += joins ? -this->Pairs.weights[e] : this->Pairs.weights[e];
      own.conducted += joins ? -part.conducted[e] : part.conducted[e];
    }
    GrowingPieces::Sum& sum = pieces[k];
    sum += own;
    const double sphere = std::sqrt(2.0 * Pi * sum.area);
    if (sum.area < LeastPart * this->Area || sum.area > 0.5 * part.area ||
      !(sum.length < LongestBorder * sphere))
    {
      continue;
    }
    const double length = std::max(sum.length, 0.0);
    const double kappa = length > 0.0 ? std::max(sum.conducted, 0.0) / length : 1.0;
    const double thinner = std::abs(
      sum.thickness / sum.area - (part.logThickness - sum.thickness) / (part.area - sum.area));
    const double q =
      length / sphere * std::pow(kappa, ConcavityPower) * std::exp(-ThicknessWeight * thinner);
    if (q < best.q)
    {
      best.q = q;
      best.level = levels[k];
      best.sample = k;
    }
  }
  return best;
}

/// The piece, with what small things it leaves over, then the pieces of the rest.
std::vector<Samples> PartFinder::CutOff(const Samples& part, const Fields& u, const Cut& cut) const
{
  std::vector<int> marks(this->Count(), NotThere);
  Samples sameSide;
  for (const int k : part)
  {
    marks[k] = cut.direction * u(k, cut.field) <= cut.direction * cut.level ? 1 : 0;
    if (marks[k] == 1)
    {
      sameSide.push_back(k);
    }
  }
  for (const Samples& piece : this->Pieces(sameSide, marks))
  {
    const int mark = std::binary_search(piece.begin(), piece.end(), cut.sample) ? 1 : 0;
    for (const int k : piece)
    {
      marks[k] = mark;
    }
  }
  for (const Samples& piece : this->Pieces(part, marks))
  {
    if (marks[piece.front()] == 0 && this->AreaOf(piece) < LeastPart * this->Area)
    {
      for (const int k : piece)
      {
        marks[k] = 1;
      }
    }
  }
  return this->Pieces(part, marks);
}

bool PartFinder::AreEnough(std::size_t parts) const
{
  const int wanted = this->Options.numberOfParts;
  return wanted > 0 && parts >= static_cast<std::size_t>(wanted);
}

OpenPart PartFinder::Open(Samples samples, bool search)
{
  OpenPart part;
  part.samples = std::move(samples);
  part.area = this->AreaOf(part.samples);
  if (!search || part.area < 2.0 * LeastPart * this->Area)
  {
    return part;
  }
  if (this->Asked && !this->Asked(++this->Searches, 0.0))
  {
    throw SolveAborted{};
  }
  const Fields u = this->FieldsOf(part.samples);
  const Swept swept = this->PrepareSweeps(part.samples, part.area);
  std::vector<Cut> cuts(2 * u.cols());
  ParallelTasks(static_cast<int>(u.cols()), this->Options.threads,
    [&](int field)
    {
      const std::array<Cut, 2> found = this->Sweep(swept, u, field);
      std::copy(found.begin(), found.end(), cuts.begin() + 2 * static_cast<std::ptrdiff_t>(field));
    });
  const Cut& best = *std::min_element(
    cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.q < b.q; });
  if (best.sample != NotThere)
  {
    part.pieces = this->CutOff(part.samples, u, best);
    if (part.pieces.size() > 1)
    {
      part.q = best.q;
    }
  }
  return part;
}

/// kappa becomes 1 near borders between the pieces.
void PartFinder::Heal(const std::vector<Samples>& pieces)
{
  std::vector<int> pieceOf(this->Count(), NotThere);
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    for (const int k : pieces[p])
    {
      pieceOf[k] = static_cast<int>(p);
    }
  }
  std::vector<double> distance(this->Count(), NoCut);
  const auto forOthers = [&](int k, const auto& f)
  {
    for (int e = this->Pairs.first[k]; e < this->Pairs.first[k + 1]; ++e)
    {
      if (pieceOf[this->Pairs.others[e]] != NotThere)
      {
        f(this->Pairs.others[e]);
      }
    }
  };
  std::vector<int> borders;
  for (int k = 0; k < static_cast<int>(pieceOf.size()); ++k)
  {
    if (pieceOf[k] != NotThere)
    {
      forOthers(k, [&](int l) { distance[k] = pieceOf[l] != pieceOf[k] ? 0.0 : distance[k]; });
      if (distance[k] == 0.0)
      {
        borders.push_back(k);
      }
    }
  }
  const Points& x = this->Grid.GetPlaces();
  const std::vector<int> healed = LowerAlongPaths(
    distance, borders,
    [&](int k, const auto& visit)
    { forOthers(k, [&](int l) { visit(l, (x.row(k) - x.row(l)).norm()); }); },
    HealedBorder * PartSize);
  this->Conductivity(healed).setOnes();
}

/// What does not hang together; what is too small to be a part is left to the nearest that is not.
std::vector<OpenPart> PartFinder::LoosePieces()
{
  Samples all(this->Count());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Samples> pieces = this->Pieces(all, std::vector<int>(all.size(), 0));
  const auto isLarge = [this](const Samples& piece)
  { return this->AreaOf(piece) >= LeastPart * this->Area; };
  const auto small = std::stable_partition(pieces.begin(), pieces.end(), isLarge);
  if (small == pieces.begin()) // nothing is large: all is one
  {
    pieces = { all };
  }
  else
  {
    const Points& x = this->Grid.GetPlaces();
    Samples large;
    for (auto piece = pieces.begin(); piece != small; ++piece)
    {
      large.insert(large.end(), piece->begin(), piece->end());
    }
    for (auto piece = small; piece != pieces.end(); ++piece)
    {
      const Eigen::RowVector3d center = x(*piece, AllColumns).colwise().mean();
      const int nearest = *std::min_element(large.begin(), large.end(),
        [&](int k, int l)
        { return (x.row(k) - center).squaredNorm() < (x.row(l) - center).squaredNorm(); });
      for (const int k : *piece)
      {
        this->Strays.emplace_back(k, nearest);
      }
    }
    pieces.erase(small, pieces.end());
  }
  std::vector<OpenPart> open;
  open.reserve(pieces.size());
  const bool search = !this->AreEnough(pieces.size());
  for (Samples& piece : pieces)
  {
    open.push_back(this->Open(std::move(piece), search));
  }
  return open;
}

SurfacePartsResult PartFinder::Find()
{
  std::vector<OpenPart> open = this->LoosePieces();
  while (!this->AreEnough(open.size()))
  {
    const auto best = std::min_element(
      open.begin(), open.end(), [](const OpenPart& a, const OpenPart& b) { return a.q < b.q; });
    if (best->q == NoCut || (this->Options.numberOfParts == 0 && best->q >= WorstCut))
    {
      break;
    }
    std::vector<Samples> pieces = std::move(best->pieces);
    open.erase(best);
    this->Heal(pieces);
    const bool search = !this->AreEnough(open.size() + pieces.size());
    for (Samples& piece : pieces)
    {
      open.push_back(this->Open(std::move(piece), search));
    }
  }
  return this->Result(open);
}

SurfacePartsResult PartFinder::Result(const std::vector<OpenPart>& parts)
{
  const int count = static_cast<int>(parts.size());
  std::vector<int> partOf(this->Count(), NotThere);
  for (int p = 0; p < count; ++p)
  {
    for (const int k : parts[p].samples)
    {
      partOf[k] = p;
    }
  }
  for (const auto& [k, nearest] : this->Strays)
  {
    partOf[k] = partOf[nearest];
  }
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(count);
  Eigen::VectorXd logThickness = Eigen::VectorXd::Zero(count);
  Fields shares = Fields::Zero(this->Count(), count);
  for (Eigen::Index k = 0; k < this->Count(); ++k)
  {
    const int p = partOf[k];
    shares(k, p) = 1.0;
    areas(p) += this->Weights(k);
    logThickness(p) += this->Weights(k) * this->LogThickness(k);
  }
  const int threads = this->Options.threads;
  shares = this->Grid.AtPoints(this->Grid.Smooth(shares, threads), this->P, threads);
  SurfacePartsResult result;
  result.parts.resize(shares.rows());
  std::vector<int> numbers(count, NotThere); // a part of few samples may be of no point
  for (Eigen::Index i = 0; i < shares.rows(); ++i)
  {
    shares.row(i).maxCoeff(&result.parts[i]);
    numbers[result.parts[i]] = 0;
  }
  for (int p = 0; p < count; ++p)
  {
    if (numbers[p] != NotThere)
    {
      numbers[p] = result.count++;
      result.thickness.push_back(std::exp(logThickness(p) / areas(p)));
    }
  }
  for (int& part : result.parts)
  {
    part = numbers[part];
  }
  return result;
}
}

SurfacePartsResult FindParts(
  const Points& P, const Triangles& F, const PartsOptions& options, const Callback& callback)
{
  return PartFinder(P, F, options, callback).Find();
}
} // namespace SphericalStyle
