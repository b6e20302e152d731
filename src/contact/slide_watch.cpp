#include "contact/slide_watch.h"

#include <algorithm>
#include <cmath>

#include "common/matrix3.h"
#include "contact/interface_traces.h"

namespace pounding {
namespace {

/// The outward normal of the secondary side, whose terms are the last ones.
Vector3 normal_of(const Constraint& constraint) {
  Vector3 normal{0, 0, 0};
  const ConstraintTerm& last = constraint.terms.back();
  for (const ConstraintTerm& term : constraint.terms) {
    if (term.structure == last.structure && term.node == last.node) {
      normal[term.component] = -term.coefficient;
    }
  }
  return normal;
}

/// Two unit vectors across a unit vector and each other; axes for an axis.
std::array<Vector3, 2> tangents_of(const Vector3& normal) {
  const std::size_t smallest =
      std::ranges::min_element(normal, {}, [](double x) { return std::abs(x); }) - normal.begin();
  Vector3 axis{0, 0, 0};
  axis[smallest] = 1;
  const Vector3 first = normalised(cross(normal, axis));
  return {first, cross(normal, first)};
}

/// The weight of every node of a constraint, -1 for the secondary.
std::vector<ConstraintTerm> weights_of(const Constraint& constraint, const Vector3& normal) {
  std::vector<ConstraintTerm> nodes;
  for (const ConstraintTerm& term : constraint.terms) {
    if (nodes.empty() || nodes.back().structure != term.structure ||
        nodes.back().node != term.node) {
      nodes.push_back({term.structure, term.node, 0, 0});
    }
    nodes.back().coefficient += term.coefficient * normal[term.component];
  }
  return nodes;
}

}  // namespace

std::vector<Constraint> tangential_rows(std::span<const Constraint> constraints) {
  std::vector<Constraint> rows;
  for (const Constraint& constraint : constraints) {
    const Vector3 normal = normal_of(constraint);
    const std::vector<ConstraintTerm> nodes = weights_of(constraint, normal);
    for (const Vector3& tangent : tangents_of(normal)) {
      Constraint& row = rows.emplace_back();
      row.contact = constraint.contact;
      for (const ConstraintTerm& node : nodes) {
        for (int d = 0; d < 3; ++d) {
          const double coefficient = node.coefficient * tangent[d];
          if (coefficient != 0) row.terms.push_back({node.structure, node.node, d, coefficient});
        }
      }
    }
  }
  return rows;
}

SlideWatch::SlideWatch(MPI_Comm comm, const Interface& interface,
                       std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                       int contacts)
    : operator_(comm, tangential_rows(interface.constraints), meshes),
      traces_(make_traces(operator_, systems, meshes, false)),
      gather_(comm, known_dofs(dofs_by_structure(operator_, systems.size()), traces_)),
      displacement_(static_cast<std::size_t>(operator_.dofs()), 0.0),
      slides_(static_cast<std::size_t>(contacts)) {
  std::size_t known = 0;
  for (const Trace& trace : traces_) {
    first_known_.push_back(known);
    known += trace.known().size();
  }
  mine_.assign(known, 0.0);
  for (const Constraint& constraint : interface.constraints) {
    contact_.push_back(constraint.contact);
    facet_size_.push_back(constraint.facet_size);
  }
}

void SlideWatch::set_displacement(std::size_t structure, const double* displacement) {
  traces_[structure].apply(displacement, mine_.data() + first_known_[structure], 1);
}

void SlideWatch::look(double time) {
  gather_.gather(1, mine_, displacement_);
  for (std::size_t i = 0; i < contact_.size(); ++i) {
    const int row = 2 * static_cast<int>(i);
    const double distance =
        std::hypot(operator_.apply(row, displacement_), operator_.apply(row + 1, displacement_));
    const double size = facet_size_[i];
    Slide& slide = slides_[contact_[i]];
    if (size > 0 && distance > Slide::limit * size && slide.since < 0) slide.since = time;
    // All pairs of a contact face facets, or all a wall.
    if (size > 0 ? distance * slide.facet_size > slide.distance * size || slide.facet_size == 0
                 : distance > slide.distance) {
      slide.distance = distance;
      slide.facet_size = size;
    }
  }
}

void SlideWatch::save(SavedState& saved) const {
  std::vector<double> values;
  for (const Slide& slide : slides_) {
    values.insert(values.end(), {slide.distance, slide.facet_size, slide.since});
  }
  saved.put("contact_slide", values, 3);
}

void SlideWatch::load(const SavedState& saved) {
  std::vector<double> values(3 * slides_.size());
  saved.get("contact_slide", values);
  for (std::size_t c = 0; c < slides_.size(); ++c) {
    slides_[c] = {values[3 * c], values[3 * c + 1], values[3 * c + 2]};
  }
}

}  // namespace pounding
