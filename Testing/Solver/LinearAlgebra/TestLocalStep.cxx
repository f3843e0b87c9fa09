// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The closed form for the closest rotation against Eigen's SVD, and the threads of the local step.
#include "Check.h"
#include "LocalStep.h"
#include "Meshes.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cstring>
#include <string>

using namespace SphericalStyle;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
double WorstTrace = 0.0;
double WorstOrthonormal = 0.0;
Matrices Checked; // every S that was looked at, for TestEightAtATime

// Everything that holds for any S. Traces are compared relative to |S|: tr(R S) itself may vanish
// by cancellation.
void CheckRotation(const Matrix3d& S, const std::string& what, Meshes::Random& random)
{
  const Matrix3d R = ClosestRotation(S), expected = ClosestRotationSVD(S);
  Checked.push_back(S);
  for (const Matrix3d& rotation : { R, expected })
  {
    CHECK(rotation.allFinite(), what << ": the rotation should be finite; S =\n" << S);
    const double error = (rotation.transpose() * rotation - Matrix3d::Identity()).norm();
    WorstOrthonormal = std::max(WorstOrthonormal, error);
    CHECK(error <= 1e-12, what << ": R^T R differs from I by " << error << "; S =\n" << S);
    CHECK_NEAR(rotation.determinant(), 1.0, 1e-12, what << ": det R");
  }
  const double largest = S.cwiseAbs().maxCoeff();
  if (largest == 0.0)
  {
    CHECK(R == Matrix3d::Identity(), what << ": S = 0 should give the identity");
    return;
  }
  const Matrix3d unit = S / largest; // its norm neither overflows nor underflows
  const double norm = unit.norm();
  const double error = std::abs((R * unit).trace() - (expected * unit).trace()) / norm;
  WorstTrace = std::max(WorstTrace, error);
  CHECK(error <= 1e-12,
    what << ": tr(R S) differs from that of the SVD by " << error << "; S =\n"
         << S);
  for (int k = 0; k < 20; ++k)
  {
    const Matrix3d other = random.Rotation();
    CHECK((other * unit).trace() <= (R * unit).trace() + 1e-12 * norm,
      what << ": a random rotation should not beat R; S =\n"
           << S);
  }
}

Matrix3d WithSingularValues(const Vector3d& s, Meshes::Random& random)
{
  return random.Rotation() * s.asDiagonal() * random.Rotation();
}

void TestClosestRotation()
{
  Meshes::Random random(1);
  for (int k = 0; k < 2000; ++k)
  {
    const Matrix3d S = random.Matrix();
    CheckRotation(S, "random", random);
    CheckRotation(-S, "reflected", random);
    const double scale = std::pow(10.0, 150.0 * random.Signed());
    CheckRotation(scale * S, "scaled by " + std::to_string(std::log10(scale)), random);
  }
  for (int k = 0; k < 500; ++k)
  {
    const double scale = k % 2 == 0 ? 1.0 : std::pow(10.0, 100.0 * random.Signed());
    const double x = random.Unit(), y = random.Unit();
    const double small = std::pow(10.0, -2.0 - 16.0 * random.Unit());
    const auto make = [&](double s1, double s2, double s3) -> Matrix3d {
      return scale * WithSingularValues({ s1, s2, s3 }, random);
    };
    CheckRotation(make(1, x, 0), "rank 2", random);
    CheckRotation(make(1, 0, 0), "rank 1", random);
    CheckRotation(make(1, small, 0), "nearly rank 1", random);
    CheckRotation(make(1, small, 0.5 * small), "nearly rank 1, three values", random);
    CheckRotation(make(1, small, -0.9 * small), "nearly rank 1, reflected", random);
    CheckRotation(make(1, x, small), "nearly rank 2", random);
    CheckRotation(make(1, x, -small), "nearly rank 2, reflected", random);
    CheckRotation(make(1, x, -x), "s2 = -s3", random);
    CheckRotation(make(1, x, -x * (1.0 - small)), "s2 ~ -s3", random);
    CheckRotation(make(1, 1, -1), "a reflection", random);
    CheckRotation(make(1, 1, -1 + small), "nearly a reflection", random);
    CheckRotation(make(-1, -1, -1), "a point reflection", random);
    CheckRotation(make(1, 1, y), "two values equal", random);
    CheckRotation(make(1, 1, 1), "all values equal", random);
    CheckRotation(make(1, x, x), "the lower values equal", random);
  }
  CheckRotation(Matrix3d::Zero(), "zero", random);
  CheckRotation(Matrix3d::Identity(), "identity", random);
  CheckRotation(-Matrix3d::Identity(), "minus identity", random);
  CheckRotation(Vector3d(1, 1, -1).asDiagonal().toDenseMatrix(), "a mirror", random);
  CheckRotation(Vector3d(1, 0, 0).asDiagonal().toDenseMatrix(), "one axis", random);
  CheckRotation(Matrix3d::Ones(), "all ones", random);
}

// Every S so far, next to others of all kinds, through the form that works on eight at a time.
void TestEightAtATime()
{
  Checked.push_back(Matrix3d::Constant(std::nan("")));
  Matrices R(Checked.size(), Matrix3d::Identity());
  FitRotations(Checked, R, 1);
  CHECK(R.back() == Matrix3d::Identity(), "S that is not a number should give the identity");
  for (std::size_t i = 0; i + 1 < R.size(); ++i)
  {
    const double largest = Checked[i].cwiseAbs().maxCoeff();
    const Matrix3d unit = Checked[i] / (largest > 0.0 ? largest : 1.0);
    const double error = ((ClosestRotationSVD(Checked[i]) - R[i]) * unit).trace();
    CHECK(std::abs(error) <= 1e-12 * unit.norm(),
      "matrix " << i << ": tr(R S) differs from that of the SVD by " << error << "; S =\n"
                << Checked[i]);
    const double defect = (R[i].transpose() * R[i] - Matrix3d::Identity()).norm();
    CHECK(defect <= 1e-12, "matrix " << i << ": R^T R differs from I by " << defect);
    CHECK(R[i].determinant() > 0.0, "matrix " << i << ": R should be no reflection");
    Matrix3d alone = Matrix3d::Identity();
    FitRotations(Checked[i].data(), 1, &alone);
    CHECK(alone == R[i], "matrix " << i << ": its neighbors should not matter");
  }
}

// S of points turned by a rotation gives this rotation back.
void TestRotationsRecovered()
{
  Meshes::Random random(2);
  double worst = 0.0;
  for (int k = 0; k < 500; ++k)
  {
    const Matrix3d turn = random.Rotation();
    Matrix3d S = Matrix3d::Zero(), flat = Matrix3d::Zero();
    for (int j = 0; j < 6; ++j)
    {
      const Vector3d e = random.InCube();
      S += e * (turn * e).transpose();
      const Vector3d inPlane(e[0], e[1], 0.0); // a flat cell: rank 2, still determined
      flat += inPlane * (turn * inPlane).transpose();
    }
    worst = std::max(worst, (ClosestRotation(S) - turn).norm());
    CHECK((ClosestRotation(S) - turn).norm() <= 1e-11, "the rotation should be recovered");
    CHECK((ClosestRotationSVD(S) - turn).norm() <= 1e-11, "the SVD should recover the rotation");
    CHECK((ClosestRotation(flat) - turn).norm() <= 1e-9,
      "the rotation of a flat cell should be recovered, is off by "
        << (ClosestRotation(flat) - turn).norm());
  }
  std::cout << "recovered rotations to " << worst << std::endl;
}

/// 1 where det S >= 0, else (s2 - s3) / (s2 + s3) of singular values that are known.
void TestCertainty()
{
  Meshes::Random random(7);
  for (int i = 0; i < 200; ++i)
  {
    const double s3 = 0.1 * (i % 9);
    const double s2 = s3 + 0.05 * (i % 5);
    const Matrix3d turned =
      random.Rotation() * Vector3d(s2 + 0.3, s2, s3).asDiagonal() * random.Rotation();
    const Matrix3d mirrored =
      random.Rotation() * Vector3d(s2 + 0.3, s2, -s3).asDiagonal() * random.Rotation();
    CHECK(s3 == 0.0 || RotationCertainty(turned, ClosestRotation(turned)) == 1.0,
      "a rotation near to a turned shape is certain");
    if (s3 > 0.0)
    {
      CHECK_NEAR(RotationCertainty(mirrored, ClosestRotation(mirrored)), (s2 - s3) / (s2 + s3),
        1e-9, "the certainty of a mirrored shape's rotation");
    }
  }
  // Of rank one: the smaller values are rounding, of either sign.
  for (int i = 0; i < 2000; ++i)
  {
    const double noise = std::pow(10.0, -9.0 - i % 9);
    Matrix3d S = random.Rotation() * Vector3d(1.0, 0.0, 0.0).asDiagonal() * random.Rotation();
    S += noise * random.Rotation() * Vector3d(0.3, 0.2, -0.1).asDiagonal();
    const double certainty = RotationCertainty(S, ClosestRotation(S));
    CHECK(certainty >= 0.0 && certainty <= 1.0 && (noise > 2e-13 || certainty == 1.0),
      "certainty " << certainty << " with noise " << noise);
  }
  const Matrix3d none = Matrix3d::Zero();
  CHECK(RotationCertainty(none, ClosestRotation(none)) == 1.0, "nothing to turn is certain");
}

bool SameBits(const Matrices& A, const Matrices& B)
{
  for (std::size_t i = 0; i < A.size(); ++i)
  {
    if (std::memcmp(A[i].data(), B[i].data(), 9 * sizeof(double)) != 0)
    {
      return false;
    }
  }
  return A.size() == B.size();
}

void TestFitRotations()
{
  Meshes::Random random(3);
  const int n = 20000; // enough for several threads to start
  // Cells of three vectors x_j that became y_j; E = sum |y - R x|^2.
  std::vector<std::array<Vector3d, 6>> cells(n);
  Matrices S(n), start(n);
  for (int i = 0; i < n; ++i)
  {
    S[i].setZero();
    const Matrix3d turn = random.Rotation();
    for (int j = 0; j < 3; ++j)
    {
      cells[i][2 * j] = random.InCube();
      cells[i][2 * j + 1] = turn * cells[i][2 * j] + 0.3 * random.InCube();
      S[i] += cells[i][2 * j] * cells[i][2 * j + 1].transpose();
    }
    start[i] = random.Rotation();
  }
  const auto energy = [&](const Matrices& R)
  {
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        sum += (cells[i][2 * j + 1] - R[i] * cells[i][2 * j]).squaredNorm();
      }
    }
    return sum;
  };
  Matrices R = start;
  const double change = FitRotations(S, R, 1);
  const double expected = energy(R) - energy(start);
  CHECK(change < 0.0, "fitting should lower the energy, changes it by " << change);
  CHECK_NEAR(change, expected, 1e-11 * energy(start), "the change of the energy");
  for (const int threads : { 2, 3, 8 })
  {
    Matrices other = start;
    const double otherChange = FitRotations(S, other, threads);
    CHECK(SameBits(R, other), threads << " threads should give the same bits as one");
    CHECK(change == otherChange, threads << " threads should sum to the same bits as one");
  }
  const double second = FitRotations(S, R, 1);
  CHECK(std::abs(second) <= 1e-12 * energy(start),
    "a second fit should change nothing, changes " << second);
}
} // namespace

int main()
{
  TestClosestRotation();
  TestEightAtATime();
  TestRotationsRecovered();
  TestCertainty();
  TestFitRotations();
  std::cout << "largest difference of tr(R S) / |S| from the SVD " << WorstTrace
            << ", of R^T R from I " << WorstOrthonormal << std::endl;
  return CheckResult();
}
