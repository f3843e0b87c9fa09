// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A vector on every half-edge, where possible without storing it.
#ifndef SphericalStyle_HalfEdgeField_h
#define SphericalStyle_HalfEdgeField_h

#include "TriangleMesh.h"
#include "Vector4.h"

#include <utility>

namespace SphericalStyle
{
/// Rest edges and targets of one center are differences x_u - x_v of a field of the
/// points: those are worked out where they are needed, from a third of the memory of what they
/// would take up. Targets of several centers and changed ones are vectors of their own.
class HalfEdgeField
{
public:
  /// No vectors.
  HalfEdgeField() = default;
  /// scale (x_u - x_v). @param x  n x 3; kept by reference, must outlive this
  explicit HalfEdgeField(const Points& x, double scale = 1.0)
    : Potential(&x)
    , Scale(scale)
  {
  }
  /// @param vectors  m x 9
  HalfEdgeField(HalfEdgeVectors vectors)
    : Vectors(std::move(vectors))
  {
  }

  /// Whether it is the difference of a field of the points.
  bool IsDifference() const { return this->Potential != nullptr; }

  /// The three vectors of triangle f as columns.
  Eigen::Matrix3d Of(const Triangles& F, Eigen::Index f) const
  {
    if (!this->Potential)
    {
      return Eigen::Map<const Eigen::Matrix3d>(this->Vectors.row(f).data());
    }
    Eigen::Matrix3d x;
    for (int k = 0; k < 3; ++k)
    {
      x.col(k) = this->Scale *
        (this->Potential->row(F(f, HalfEdgeStart(k))) - this->Potential->row(F(f, HalfEdgeEnd(k))));
    }
    return x;
  }

  /// The same as vectors of four, for code that is compiled per instruction set.
  class Reader
  {
  public:
    explicit Reader(const HalfEdgeField& field)
      : Potential(field.Potential ? field.Potential->data() : nullptr)
      , LastPoint(field.Potential ? static_cast<int>(field.Potential->rows()) - 1 : -1)
      , Scale(field.Scale)
      , Vectors(field.Vectors.data())
    {
    }

    SPHERICALSTYLE_INLINE void Read(const int* corner, int f, Vector4 vectors[3]) const
    {
      if (!this->Potential)
      {
        const double* own = this->Vectors + 9 * static_cast<std::ptrdiff_t>(f);
        for (int k = 0; k < 3; ++k)
        {
          vectors[k] = Load3(own + 3 * k);
        }
        return;
      }
      const Vector4 x[3] = { this->Point(corner[0]), this->Point(corner[1]),
        this->Point(corner[2]) };
      for (int k = 0; k < 3; ++k)
      {
        vectors[k] = this->Scale * (x[HalfEdgeStart(k)] - x[HalfEdgeEnd(k)]);
      }
    }

    /// Of a difference, where corners 0 and 1 lie from corner 2: the half-edges are [1], -[0] and
    /// [0] - [1].
    SPHERICALSTYLE_INLINE void ReadFromLast(const int* corner, Vector4 x[2]) const
    {
      const Vector4 last = this->Point(corner[2]);
      x[0] = this->Scale * (this->Point(corner[0]) - last);
      x[1] = this->Scale * (this->Point(corner[1]) - last);
    }

  private:
    SPHERICALSTYLE_INLINE Vector4 Point(int i) const
    {
      const double* x = this->Potential + 3 * static_cast<std::ptrdiff_t>(i);
      return i == this->LastPoint ? Load3(x) : Load4(x); // nothing follows the last one
    }

    const double* Potential;
    int LastPoint;
    double Scale;
    const double* Vectors;
  };

private:
  const Points* Potential = nullptr;
  double Scale = 1.0;
  HalfEdgeVectors Vectors = HalfEdgeVectors(0, 9);
};
} // namespace SphericalStyle

#endif
