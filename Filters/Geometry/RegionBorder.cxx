// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RegionBorder.h"

#include "Parallel.h"
#include "SurfaceMesh.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>

#include <cmath>

namespace SphericalStyle
{
Eigen::VectorXd BorderWeights(
  const Points& P, const std::vector<char>& inside, double width, int threads)
{
  using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;
  Search::Tree outside;
  Eigen::VectorXd weights(P.rows());
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    weights[i] = inside[i] ? 1.0 : 0.0;
    if (!inside[i])
    {
      outside.insert(ToPoint(P, i));
    }
  }
  if (outside.empty() || !(width > 0.0))
  {
    return weights;
  }
  outside.build(); // before the threads ask
  ParallelFor(static_cast<int>(P.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        if (inside[i])
        {
          const Search nearest(outside, ToPoint(P, i), 1);
          const double x = std::sqrt(nearest.begin()->second) / width;
          weights[i] = x < 1.0 ? x * x * x * (x * (6.0 * x - 15.0) + 10.0) : 1.0;
        }
      }
    });
  return weights;
}
} // namespace SphericalStyle
