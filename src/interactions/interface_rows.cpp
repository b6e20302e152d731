#include "interactions/interface_rows.h"

#include <algorithm>

namespace pounding::interactions {

InterfaceRows::InterfaceRows(MPI_Comm comm, const std::vector<Constraint>& constraints,
                             std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                             std::span<const ConstraintTerm> more)
    : operator_(comm, constraints, meshes, more),
      structure_dofs_(dofs_by_structure(operator_, systems.size())),
      traces_(make_traces(operator_, systems, meshes, true)),
      known_place_(dofs(), -1),
      gather_(comm, known_dofs(structure_dofs_, traces_)),
      compliance_(comm, operator_.dof_list(), traces_) {
  std::size_t known = 0;
  for (std::size_t s = 0; s < traces_.size(); ++s) {
    const std::vector<int>& places = traces_[s].known();
    for (std::size_t k = 0; k < places.size(); ++k) {
      known_place_[structure_dofs_[s][places[k]]] = static_cast<int>(k);
    }
    first_known_.push_back(known);
    known += places.size();
  }
  mine_.assign(InterfaceGather::max_fields * known, 0.0);
  place_impulse_.assign(known, 0.0);
}

void InterfaceRows::set(std::size_t structure, std::size_t field, std::size_t fields,
                        const double* owned, std::span<const double> supports) {
  double* const values = mine_.data() + fields * first_known_[structure] + field;
  traces_[structure].apply(owned, values, fields, supports);
}

void InterfaceRows::set_places(std::size_t structure, std::span<const double> places) {
  std::copy(places.begin(), places.end(),
            mine_.begin() + static_cast<std::ptrdiff_t>(first_known_[structure]));
}

void InterfaceRows::gather(std::size_t fields, std::span<double> values) {
  const std::size_t known = mine_.size() / InterfaceGather::max_fields;
  gather_.gather(static_cast<int>(fields), {mine_.data(), fields * known}, values);
}

void InterfaceRows::add_force(int row, double f, std::size_t structure,
                              std::span<double> owned) const {
  const auto dofs = operator_.row_dofs(row);
  for (std::size_t a = 0; a < dofs.size(); ++a) {
    const std::size_t dof = dofs[a];
    if (structure_of(dof) != structure || known_place_[dof] < 0) continue;
    traces_[structure].add_force(static_cast<std::size_t>(known_place_[dof]),
                                 f * operator_.row_coefficients(row)[a], owned);
  }
}

void InterfaceRows::pick(std::size_t structure, std::span<const double> impulses) {
  const std::vector<int>& known = traces_[structure].known();
  for (std::size_t k = 0; k < known.size(); ++k) {
    place_impulse_[k] = impulses[structure_dofs_[structure][known[k]]];
  }
}

void InterfaceRows::add_velocity_change(std::size_t structure, std::span<const double> impulses,
                                        double* velocity) {
  pick(structure, impulses);
  traces_[structure].add_impulse(place_impulse_.data(), velocity);
}

double InterfaceRows::support_work(std::size_t structure, std::span<const double> impulses,
                                   std::span<const double> velocity) {
  pick(structure, impulses);
  return traces_[structure].support_work(place_impulse_, velocity);
}

}  // namespace pounding::interactions
