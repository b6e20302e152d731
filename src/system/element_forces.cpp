#include "system/element_forces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "common/parallel.h"
#include "elements/force_rows.h"
#include "elements/geometric_stiffness.h"
#include "mesh/element_properties.h"
#include "mesh/halo.h"
#include "mesh/location.h"
#include "stiffness/element_loop.h"
#include "system/each_element.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

/// Places of elements in the list of an item, by region and number.
using Places = std::map<std::pair<int, std::int64_t>, std::size_t>;

Places places_of(const ResolvedForce& force) {
  Places places;
  for (std::size_t i = 0; i < force.elements.size(); ++i) {
    places[{force.regions[i], force.elements[i]}] = i;
  }
  return places;
}

/// An element of an item, and its dofs as places that do not depend on the partition.
struct Chosen {
  const ElementBlock& block;
  std::size_t place = 0;  ///< in the list of the item
  std::span<const double> coordinates;
  std::span<const double> stiffness;
  std::vector<TracePoint> points;
  std::vector<LocalIndex> nodes;  ///< of the mesh, per point
};

/// Calls `visit` for those elements of an item that this rank has.
template <typename Visit>
void for_each_chosen(const Structure& structure, const Mesh& mesh, const ResolvedForce& force,
                     Visit&& visit) {
  const Places places = places_of(force);
  const auto wanted = [&](const ElementBlock& block, std::size_t e) {
    return places.contains({block.region, block.tags[e]});
  };
  for_each_element(
      structure, mesh, wanted,
      [&](const ElementBlock& block, std::size_t e, const ElementLayout& layout,
          stiffness::ElementWork& work) {
        const auto size = static_cast<std::size_t>(layout.size());
        Chosen chosen{block,
                      places.at({block.region, block.tags[e]}),
                      gather_coordinates(mesh, block, e, work),
                      {work.stiffness.data(), size * size},
                      {},
                      {}};
        for (std::size_t i = 0; i < size; ++i) {
          const auto components = static_cast<std::size_t>(layout.components);
          const LocalIndex node = block.connectivity[(e * size + i) / components];
          chosen.nodes.push_back(node);
          chosen.points.push_back({mesh.file_node[node], static_cast<int>(i % components)});
        }
        visit(chosen);
      });
}

/// Binary digits of the largest force that are kept.
constexpr int kept_digits = 30;

double rounded(double force, double unit) {
  return unit > 0 ? std::round(force / unit) * unit : 0;
}

}  // namespace

ElementForces::ElementForces(const LinearSystem& system, const Mesh& mesh,
                             const std::vector<Row>& rows) {
  std::map<TracePoint, std::size_t> number;
  for (const Row& row : rows) {
    for (const TracePoint& point : row.points) {
      if (mesh.owned_node(point.node) >= 0) number.emplace(point, 0);
    }
  }
  std::vector<TracePoint> places;
  for (auto& [point, place] : number) {
    place = places.size();
    places.push_back(point);
  }
  trace_ = std::make_unique<Trace>(system, mesh, places, false);
  field_.assign(places.size(), 0.0);
  std::span<const SupportColumn> columns;
  if (system.supports) columns = system.supports->columns;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.points.size(); ++i) {
      const auto found = number.find(row.points[i]);
      if (found == number.end() || row.coefficients[i] == 0) continue;
      terms_.push_back({row.column, found->second, row.coefficients[i]});
      for (std::size_t c = 0; row.grounded && c < columns.size(); ++c) {
        const TracePoint& point = row.points[i];
        const double moved =
            ground_displacement(columns[c], mesh, mesh.owned_node(point.node), point.component);
        if (moved != 0) ground_.push_back({row.column, c, -row.coefficients[i] * moved});
      }
    }
  }
  if (system.generalised) take_forms();
}

void ElementForces::take_forms() {
  std::map<std::size_t, Form> forms;
  for (const Term& term : terms_) forms[term.column].column = term.column;
  if (forms.size() >= field_.size()) return;
  const auto add = [](std::span<const double> row, double factor, std::vector<double>& to) {
    to.resize(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) to[i] += factor * row[i];
  };
  for (const Term& term : terms_) {
    add(trace_->row(term.place), term.coefficient, forms[term.column].coordinates);
    add(trace_->carried(term.place), term.coefficient, forms[term.column].supports);
  }
  terms_.clear();
  for (auto& [column, form] : forms) forms_.push_back(std::move(form));
}

void ElementForces::add(std::span<const double> owned, std::span<const double> supports,
                        std::span<double> columns) {
  const auto product = [](const std::vector<double>& form, std::span<const double> values) {
    const std::size_t size = std::min(form.size(), values.size());
    return std::inner_product(form.begin(), form.begin() + size, values.begin(), 0.0);
  };
  for (const Form& form : forms_) {
    columns[form.column] += product(form.coordinates, owned) + product(form.supports, supports);
  }
  if (!terms_.empty()) trace_->apply(owned.data(), field_.data(), 1, supports);
  for (const Term& term : terms_) columns[term.column] += term.coefficient * field_[term.place];
  for (const GroundTerm& term : ground_) {
    columns[term.column] += term.coefficient * supports[term.support];
  }
}

std::span<const std::string_view> element_force_names(ElementType type) {
  if (is_shell(type)) return shell_force_names;
  return end_force_names(type);
}

std::vector<ElementForces::Row> member_rows(const Structure& structure, const Mesh& mesh,
                                            const ResolvedForce& chosen, std::size_t first) {
  std::vector<ElementForces::Row> rows;
  for_each_chosen(structure, mesh, chosen, [&](const Chosen& element) {
    const ElementType type = element.block.type;
    const ElementProperties properties =
        element_properties(structure.regions[element.block.region]);
    const std::size_t count = element_force_names(type).size();
    const std::vector<double> forces =
        is_shell(type) ? shell_force_rows(type, element.coordinates, properties)
                       : end_force_rows(type, element.coordinates, properties, element.stiffness);
    for (std::size_t k = 0; k < count; ++k) {
      const double* const row = &forces[k * element.points.size()];
      rows.push_back({first + count * element.place + k,
                      element.points,
                      {row, row + element.points.size()},
                      is_grounded(type)});
    }
  });
  return rows;
}

std::vector<ElementForces::Row> total_rows(const Structure& structure, const Mesh& mesh,
                                           const ForceItem& item, const ResolvedForce& passing,
                                           std::size_t first) {
  std::vector<ElementForces::Row> rows;
  for_each_chosen(structure, mesh, passing, [&](const Chosen& element) {
    const std::size_t size = element.points.size();
    std::array<std::vector<double>, 6> sums;
    sums.fill(std::vector<double>(size, 0.0));
    for (std::size_t i = 0; i < size; ++i) {
      const LocalIndex node = element.nodes[i];
      const Vector3 x = mesh.position(node);
      if (!counts(item, mesh.free_components[node], x, element.points[i].component)) continue;
      Wrench unit{};
      add_unit_force(item.point(), x, element.points[i].component, -1, unit);
      for (std::size_t k = 0; k < unit.size(); ++k) {
        for (std::size_t j = 0; unit[k] != 0 && j < size; ++j) {
          sums[k][j] += unit[k] * element.stiffness[i * size + j];
        }
      }
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
      rows.push_back(
          {first + k, element.points, std::move(sums[k]), is_grounded(element.block.type)});
    }
  });
  return rows;
}

std::vector<double> with_ghosts(const Mesh& mesh, const std::vector<double>& owned) {
  const std::vector<GlobalIndex> ghosts = ghost_dofs(mesh);
  Halo halo(mesh.comm, mesh.first_owned_dof, mesh.owned_dofs, ghosts);
  halo.begin(owned.data());
  halo.end();
  std::vector<double> values = owned;
  values.resize(mesh.dof_count);
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    values[mesh.owned_dofs + static_cast<LocalIndex>(i)] = halo.ghosts()[halo.slot(i)];
  }
  return values;
}

LargestCompression set_axial_forces(const Structure& structure,
                                    const std::vector<double>& displacement, Mesh& mesh) {
  const std::vector<double> values = with_ghosts(mesh, displacement);
  stiffness::ElementWork work;
  double largest = 0;
  for (ElementBlock& block : mesh.blocks) {
    block.axial_force.clear();
    if (!has_axial_force(block.type)) continue;
    const ElementProperties properties = element_properties(structure.regions[block.region]);
    const ElementLayout layout = element_layout(block.type);
    for (std::size_t e = 0; e < block.count(); ++e) {
      const stiffness::ElementDofs dofs(mesh, block, e);
      std::array<double, 6> ends{};
      for (std::size_t i = 0; i < ends.size(); ++i) {
        const LocalIndex dof = dofs[i / 3 * static_cast<std::size_t>(layout.components) + i % 3];
        ends[i] = dof < 0 ? 0 : values[dof];
      }
      const double force = axial_force(gather_coordinates(mesh, block, e, work), properties, ends);
      block.axial_force.push_back(force);
      largest = std::max(largest, std::abs(force));
    }
  }
  reduce_over_ranks(mesh.comm, MPI_MAX, largest);
  const double unit = largest > 0 ? std::ldexp(1.0, std::ilogb(largest) - kept_digits) : 0;
  LargestCompression result;
  for (ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.axial_force.size(); ++e) {
      block.axial_force[e] = rounded(block.axial_force[e], unit);
      if (-block.axial_force[e] > result.force) {
        result = {-block.axial_force[e], describe_element(mesh, block, e)};
      }
    }
  }
  share_extreme(mesh.comm, MPI_MAXLOC, result.force, result.place);
  return result;
}

}  // namespace pounding
