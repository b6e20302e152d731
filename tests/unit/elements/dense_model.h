#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "dense_eigen.h"
#include "elements/element_traits.h"

namespace pounding::testing_support {

/// Stiffness and lumped mass of one element, in vectors.
struct DenseElement {
  std::vector<double> stiffness;
  std::vector<double> lumped_mass;
};

inline DenseElement dense_element(ElementType type, const std::vector<double>& coordinates,
                                  const ElementProperties& properties) {
  const auto n = static_cast<std::size_t>(element_layout(type).size());
  DenseElement element{std::vector<double>(n * n), std::vector<double>(n)};
  element_matrices(type, coordinates, properties, element.stiffness, element.lumped_mass);
  return element;
}

inline std::vector<double> multiply(const std::vector<double>& matrix,
                                    const std::vector<double>& x) {
  const std::size_t n = x.size();
  std::vector<double> y(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) y[i] += matrix[i * n + j] * x[j];
  return y;
}

inline double inner(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

/// A small structure assembled densely, to hold elements against closed forms.
class DenseModel {
 public:
  DenseModel(std::vector<Vector3> nodes, std::size_t components)
      : nodes_(std::move(nodes)), components_(components) {
    stiffness_.assign(size() * size(), 0.0);
    lumped_mass_.assign(size(), 0.0);
    is_fixed_.assign(size(), false);
  }

  std::size_t size() const { return nodes_.size() * components_; }
  std::size_t dof(std::size_t node, std::size_t component) const {
    return node * components_ + component;
  }
  const std::vector<Vector3>& nodes() const { return nodes_; }
  const std::vector<double>& stiffness() const { return stiffness_; }
  std::vector<double>& lumped_mass() { return lumped_mass_; }
  const std::vector<double>& lumped_mass() const { return lumped_mass_; }

  std::vector<double> coordinates_of(const std::vector<std::size_t>& element) const {
    std::vector<double> coordinates;
    for (const std::size_t node : element)
      coordinates.insert(coordinates.end(), nodes_[node].begin(), nodes_[node].end());
    return coordinates;
  }

  void add(ElementType type, const std::vector<std::size_t>& element,
           const ElementProperties& properties) {
    add(element, dense_element(type, coordinates_of(element), properties));
  }
  void add(const std::vector<std::size_t>& element, const DenseElement& matrices) {
    const std::size_t n = element.size() * components_;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t row = dof(element[i / components_], i % components_);
      lumped_mass_[row] += matrices.lumped_mass[i];
      for (std::size_t j = 0; j < n; ++j)
        stiffness_[row * size() + dof(element[j / components_], j % components_)] +=
            matrices.stiffness[i * n + j];
    }
  }

  void fix(std::size_t node, std::size_t component) { is_fixed_[dof(node, component)] = true; }
  void clamp(std::size_t node) {
    for (std::size_t c = 0; c < components_; ++c) fix(node, c);
  }

  /// Displacement of all dofs under `load`.
  std::vector<double> solve(const std::vector<double>& load) const {
    const std::vector<std::size_t> free = free_dofs();
    std::vector<double> reduced(free.size());
    for (std::size_t i = 0; i < free.size(); ++i) reduced[i] = load[free[i]];
    reduced = solve_positive_definite(reduced_stiffness(free), reduced);
    std::vector<double> displacement(size(), 0.0);
    for (std::size_t i = 0; i < free.size(); ++i) displacement[free[i]] = reduced[i];
    return displacement;
  }

  /// All natural frequencies, ascending [Hz].
  std::vector<double> frequencies() const {
    const std::vector<std::size_t> free = free_dofs();
    std::vector<double> mass(free.size());
    for (std::size_t i = 0; i < free.size(); ++i) mass[i] = lumped_mass_[free[i]];
    std::vector<double> values = squared_circular_frequencies(reduced_stiffness(free), mass);
    for (double& value : values) value = std::sqrt(std::max(value, 0.0)) / (2 * std::numbers::pi);
    return values;
  }

 private:
  std::vector<std::size_t> free_dofs() const {
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < size(); ++i)
      if (!is_fixed_[i]) free.push_back(i);
    return free;
  }

  std::vector<double> reduced_stiffness(const std::vector<std::size_t>& free) const {
    std::vector<double> reduced;
    reduced.reserve(free.size() * free.size());
    for (const std::size_t i : free)
      for (const std::size_t j : free) reduced.push_back(stiffness_[i * size() + j]);
    return reduced;
  }

  std::vector<Vector3> nodes_;
  std::size_t components_;
  std::vector<double> stiffness_;
  std::vector<double> lumped_mass_;
  std::vector<bool> is_fixed_;
};

}  // namespace pounding::testing_support
