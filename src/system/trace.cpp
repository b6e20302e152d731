#include "system/trace.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <stdexcept>

#include "common/row_products.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

int slot_in_field(const CoupledMass& mass, int node, LocalIndex dof) {
  const std::size_t n = node;
  return static_cast<int>(mass.offset(n)) + dof - mass.nodes()[n].begin;
}

}  // namespace

Trace::Trace(const LinearSystem& system, const Mesh& mesh, std::span<const TracePoint> points,
             bool impulses)
    : dense_(system.generalised != nullptr) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mesh.owned_node(points[i].node) >= 0) known_.push_back(static_cast<int>(i));
  }
  if (dense_) {
    take_dense_rows(system, mesh, points);
  } else {
    take_unit_rows(mesh, points);
    if (impulses && system.coupled_mass) take_coupled_dofs(*system.coupled_mass);
  }
  if (system.supports) take_supports(system, mesh, points);
  for (const LocalIndex dof : dofs_) inverse_mass_.push_back(system.inverse_mass[dof]);
  force_.assign(dofs_.size(), 0.0);
}

void Trace::take_unit_rows(const Mesh& mesh, std::span<const TracePoint> points) {
  for (const int i : known_) {
    const TracePoint& point = points[i];
    const LocalIndex dof = mesh.dof(mesh.owned_node(point.node), point.component);
    own_dof_.push_back(dof < 0 ? -1 : static_cast<int>(dofs_.size()));
    if (dof >= 0) {
      dofs_.push_back(dof);
    }
  }
}

void Trace::take_coupled_dofs(const CoupledMass& mass) {
  std::set<int> parts;  // rigid bodies and ties, and -1 for S
  for (const LocalIndex dof : dofs_) {
    const int node = mass.node_of(dof);
    field_slot_.push_back(node < 0 ? -1 : slot_in_field(mass, node, dof));
    if (node < 0) continue;
    coupled_mass_ = &mass;
    parts.insert(mass.part_of(static_cast<std::size_t>(node)));
  }
  if (coupled_mass_ == nullptr) return;
  for (const int part : parts) {
    if (part < 0) {
      coupled_parts_.added = true;
    } else {
      coupled_parts_.others.push_back(static_cast<std::size_t>(part));
    }
  }
  const std::set<LocalIndex> own(dofs_.begin(), dofs_.end());
  for (std::size_t n = 0; n < mass.nodes().size(); ++n) {
    if (!parts.contains(mass.part_of(n))) continue;
    const NodeDofs& node = mass.nodes()[n];
    for (LocalIndex dof = node.begin; dof < node.begin + node.count; ++dof) {
      if (!own.contains(dof)) {
        dofs_.push_back(dof);
        field_slot_.push_back(slot_in_field(mass, static_cast<int>(n), dof));
      }
    }
  }
  field_.assign(mass.field_size(), 0.0);
}

void Trace::take_dense_rows(const LinearSystem& system, const Mesh& mesh,
                            std::span<const TracePoint> points) {
  if (known_.empty()) return;
  const GeneralisedCoordinates& coordinates = *system.generalised;
  const std::size_t width = system.owned_dofs();
  dofs_.resize(width);
  std::iota(dofs_.begin(), dofs_.end(), LocalIndex{0});
  for (const int i : known_) {
    const TracePoint& point = points[i];
    if (mesh.dof(mesh.owned_node(point.node), point.component) < 0) {
      rows_.resize(rows_.size() + width, 0.0);
      continue;
    }
    const auto found = coordinates.row_of.find(point);
    if (found == coordinates.row_of.end()) {
      throw std::logic_error("structure " + system.name + ": no trace at node " +
                             std::to_string(point.node) + ", component " +
                             std::to_string(point.component));
    }
    const double* row = &coordinates.rows[found->second * width];
    rows_.insert(rows_.end(), row, row + width);
  }
}

void Trace::take_supports(const LinearSystem& system, const Mesh& mesh,
                          std::span<const TracePoint> points) {
  const SupportShapes& supports = *system.supports;
  columns_ = supports.columns.size();
  for (const int i : known_) {
    const TracePoint& point = points[i];
    const LocalIndex node = mesh.owned_node(point.node);
    const LocalIndex dof = mesh.dof(node, point.component);
    for (std::size_t c = 0; c < columns_; ++c) {
      double value = 0;
      if (dof < 0) {
        value = support_displacement(supports.columns[c], mesh, node, point.component);
      } else if (dense_) {
        value = supports.at_points.at(point)[c];
      } else if (!supports.shape[c].empty()) {
        value = supports.shape[c][dof];
      }
      carried_.push_back(value);
    }
  }
}

double Trace::support_work(std::span<const double> f, std::span<const double> velocity) const {
  double work = 0;
  for (std::size_t k = 0; columns_ > 0 && k < known_.size(); ++k) {
    for (std::size_t c = 0; c < columns_; ++c) work += f[k] * carried(k)[c] * velocity[c];
  }
  return work;
}

void Trace::restrict_to_dofs(const double* owned, double* x) const {
  for (std::size_t k = 0; k < dofs_.size(); ++k) x[k] = owned[dofs_[k]];
}

void Trace::apply(const double* owned, double* out, std::size_t stride,
                  std::span<const double> supports) const {
  if (dense_) {
    multiply_rows(rows_.data(), known_.size(), dofs_.size(), owned, out, stride);
  } else {
    for (std::size_t k = 0; k < own_dof_.size(); ++k) {
      out[stride * k] = own_dof_[k] < 0 ? 0 : owned[dofs_[own_dof_[k]]];
    }
  }
  carry(supports, out, stride);
}

void Trace::carry(std::span<const double> supports, double* out, std::size_t stride) const {
  if (columns_ > 0) add_columns(carried_, supports, out, stride);
}

void Trace::add_force(std::size_t k, double f, std::span<double> owned) const {
  if (!dense_) {
    if (own_dof_[k] >= 0) owned[dofs_[own_dof_[k]]] += f;
    return;
  }
  for (std::size_t i = 0; i < dofs_.size(); ++i) owned[dofs_[i]] += f * rows_[k * dofs_.size() + i];
}

void Trace::add_impulse(const double* f, double* x) {
  std::fill(force_.begin(), force_.end(), 0.0);
  for (std::size_t k = 0; k < known_.size(); ++k) {
    if (!dense_ && own_dof_[k] >= 0) {
      force_[own_dof_[k]] = f[k];
    } else if (dense_ && f[k] != 0) {
      const double* row = &rows_[k * dofs_.size()];
      for (std::size_t i = 0; i < force_.size(); ++i) {
        force_[i] += f[k] * row[i];
      }
    }
  }
  add_solution(x);
}

void Trace::add_solution(double* x) {
  if (coupled_mass_ == nullptr) {
    for (std::size_t i = 0; i < force_.size(); ++i) x[i] += inverse_mass_[i] * force_[i];
    return;
  }
  std::fill(field_.begin(), field_.end(), 0.0);
  for (std::size_t i = 0; i < force_.size(); ++i) {
    if (field_slot_[i] >= 0) field_[field_slot_[i]] = force_[i];
  }
  coupled_mass_->solve(field_.data(), coupled_parts_);
  for (std::size_t i = 0; i < force_.size(); ++i) {
    x[i] += field_slot_[i] < 0 ? inverse_mass_[i] * force_[i] : field_[field_slot_[i]];
  }
}

double Trace::compliance(std::size_t a, std::size_t b) {
  if (!dense_) {
    if (own_dof_[a] < 0 || own_dof_[b] < 0) return 0;
    if (coupled_mass_ == nullptr) return a == b ? inverse_mass_[own_dof_[a]] : 0;
    if (response_.empty() || response_point_ != a) {
      response_.assign(dofs_.size(), 0.0);
      response_point_ = a;
      std::fill(force_.begin(), force_.end(), 0.0);
      force_[own_dof_[a]] = 1;
      add_solution(response_.data());
    }
    return response_[own_dof_[b]];
  }
  double sum = 0;
  const double* row_a = &rows_[a * dofs_.size()];
  const double* row_b = &rows_[b * dofs_.size()];
  for (std::size_t i = 0; i < dofs_.size(); ++i) sum += row_a[i] * inverse_mass_[i] * row_b[i];
  return sum;
}

std::vector<TracePoint> points_of(const Mesh& mesh, const std::vector<LocalIndex>& dofs) {
  std::vector<TracePoint> points;
  for_each_owned_dof(mesh, [&](LocalIndex dof, LocalIndex node, int c) {
    if (std::ranges::binary_search(dofs, dof)) points.push_back({mesh.file_node[node], c});
  });
  return points;
}

}  // namespace pounding
