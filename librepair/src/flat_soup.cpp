#include "flat_soup.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace meshrepair::internal {
bool is_flat(const CleanSoup& soup) {
  Vec3d mean = Vec3d::Zero();
  for (const GridPoint& p : soup.grid_points) mean += as_vector(p);
  mean /= static_cast<double>(std::max<std::size_t>(soup.grid_points.size(), 1));
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const GridPoint& p : soup.grid_points) {
    const Vec3d d = as_vector(p) - mean;
    moments += d * d.transpose();
  }
  const Vec3d normal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(0);
  const double half_diagonal = std::sqrt(3.0) / 2;
  return std::all_of(soup.grid_points.begin(), soup.grid_points.end(), [&](const GridPoint& p) {
    return std::abs((as_vector(p) - mean).dot(normal)) <= half_diagonal;
  });
}

}  // namespace meshrepair::internal
