#include "interactions/interface_rows.h"

#include <algorithm>

#include "common/parallel.h"

namespace pounding::interactions {
namespace {

/// Values that are added up through common memory; more travel in a message.
constexpr std::size_t most_added = 64;

}  // namespace

InterfaceGather::InterfaceGather(MPI_Comm comm, std::span<const int> mine, bool common_memory) {
  int lowest = mine.empty() ? size_of(comm) : rank_of(comm);
  MPI_Allreduce(&lowest, &root_, 1, MPI_INT, MPI_MIN, comm);
  int counts = mine.empty() ? 0 : 1;
  MPI_Allreduce(&counts, &members_, 1, MPI_INT, MPI_SUM, comm);
  MPI_Comm_split(comm, mine.empty() ? MPI_UNDEFINED : 0, rank_of(comm), &comm_);
  if (!member()) return;
  const std::size_t members = members_;
  counts_.resize(members);
  lengths_.resize(members);
  offsets_.resize(members);
  const int count = static_cast<int>(mine.size());
  MPI_Allgather(&count, 1, MPI_INT, counts_.data(), 1, MPI_INT, comm_);
  int total = 0;
  for (std::size_t m = 0; m < members; ++m) {
    offsets_[m] = total;
    total += counts_[m];
  }
  order_.resize(total);
  MPI_Allgatherv(mine.data(), count, MPI_INT, order_.data(), counts_.data(), offsets_.data(),
                 MPI_INT, comm_);
  if (common_memory && members_ > 1) {
    shared_ = std::make_unique<SharedExchange>(
        comm_, std::max(mine.size() * static_cast<std::size_t>(max_fields), most_added));
    if (!shared_->works()) shared_.reset();
  }
  buffer_.resize(shared_ ? 0 : static_cast<std::size_t>(total * max_fields));
}

InterfaceGather::~InterfaceGather() {
  if (member()) MPI_Comm_free(&comm_);
}

/// Puts values of the gathered dofs from `first` on in their places.
void InterfaceGather::spread(int fields, std::size_t first, std::size_t end, const double* values,
                             std::span<double> all) const {
  const std::size_t dofs = order_.size();
  for (std::size_t i = first; i < end; ++i) {
    for (std::size_t f = 0; f < static_cast<std::size_t>(fields); ++f) {
      all[f * dofs + static_cast<std::size_t>(order_[i])] = *values++;
    }
  }
}

void InterfaceGather::gather(int fields, std::span<const double> mine, std::span<double> all) {
  if (members_ == 1) {
    spread(fields, 0, order_.size(), mine.data(), all);
    return;
  }
  if (shared_) {
    shared_->publish(mine);
    std::size_t first = 0;
    for (int m = 0; m < members_; ++m) {
      const std::size_t end = first + static_cast<std::size_t>(counts_[m]);
      spread(fields, first, end, shared_->wait_for(m), all);
      first = end;
    }
    return;
  }
  int total = 0;
  for (std::size_t m = 0; m < counts_.size(); ++m) {
    lengths_[m] = counts_[m] * fields;
    offsets_[m] = total;
    total += lengths_[m];
  }
  MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, buffer_.data(),
                 lengths_.data(), offsets_.data(), MPI_DOUBLE, comm_);
  spread(fields, 0, order_.size(), buffer_.data(), all);
}

void InterfaceGather::add(std::span<double> values) {
  if (members_ == 1) return;
  if (shared_ && values.size() <= most_added) {
    shared_->publish(values);
    std::fill(values.begin(), values.end(), 0.0);
    for (int m = 0; m < members_; ++m) {
      const double* const theirs = shared_->wait_for(m);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += theirs[i];
    }
    return;
  }
  reduce_over_ranks(comm_, MPI_SUM, values);
}

std::vector<std::vector<int>> dofs_by_structure(const ContactOperator& contact,
                                                std::size_t structures) {
  std::vector<std::vector<int>> dofs(structures);
  for (int i = 0; i < contact.dofs(); ++i) {
    const InterfaceDof& dof = contact.dof_list()[i];
    dofs[dof.structure].push_back(i);
  }
  return dofs;
}

std::vector<Trace> make_traces(const ContactOperator& contact,
                               std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                               bool impulses) {
  std::vector<std::vector<TracePoint>> points(systems.size());
  for (const InterfaceDof& dof : contact.dof_list()) {
    points[dof.structure].push_back({dof.node, dof.component});
  }
  std::vector<Trace> traces;
  for (std::size_t s = 0; s < systems.size(); ++s) {
    traces.emplace_back(systems[s], meshes[s], points[s], impulses);
  }
  return traces;
}

std::vector<int> known_dofs(std::span<const std::vector<int>> structure_dofs,
                            std::span<const Trace> traces) {
  std::vector<int> known;
  for (std::size_t s = 0; s < traces.size(); ++s) {
    for (const int point : traces[s].known()) known.push_back(structure_dofs[s][point]);
  }
  return known;
}

InterfaceRows::InterfaceRows(MPI_Comm comm, const std::vector<Constraint>& constraints,
                             std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                             std::span<const ConstraintTerm> more)
    : operator_(comm, constraints, meshes, more),
      structure_dofs_(dofs_by_structure(operator_, systems.size())),
      traces_(make_traces(operator_, systems, meshes, true)),
      known_point_(dofs(), -1),
      gather_(comm, known_dofs(structure_dofs_, traces_)),
      compliance_(comm, operator_.dof_list(), traces_) {
  std::size_t known = 0;
  for (std::size_t s = 0; s < traces_.size(); ++s) {
    const std::vector<int>& points = traces_[s].known();
    for (std::size_t k = 0; k < points.size(); ++k) {
      known_point_[structure_dofs_[s][points[k]]] = static_cast<int>(k);
    }
    first_known_.push_back(known);
    known += points.size();
  }
  mine_.assign(InterfaceGather::max_fields * known, 0.0);
  point_impulse_.assign(known, 0.0);
}

void InterfaceRows::set(std::size_t structure, std::size_t field, std::size_t fields,
                        const double* owned, std::span<const double> supports) {
  double* const values = mine_.data() + fields * first_known_[structure] + field;
  traces_[structure].apply(owned, values, fields, supports);
}

void InterfaceRows::set_points(std::size_t structure, std::span<const double> points,
                               std::span<const double> supports) {
  double* const values = mine_.data() + first_known_[structure];
  std::copy(points.begin(), points.end(), values);
  traces_[structure].carry(supports, values, 1);
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
    if (structure_of(dof) != structure || known_point_[dof] < 0) continue;
    traces_[structure].add_force(static_cast<std::size_t>(known_point_[dof]),
                                 f * operator_.row_coefficients(row)[a], owned);
  }
}

void InterfaceRows::pick(std::size_t structure, std::span<const double> impulses) {
  const std::vector<int>& known = traces_[structure].known();
  for (std::size_t k = 0; k < known.size(); ++k) {
    point_impulse_[k] = impulses[structure_dofs_[structure][known[k]]];
  }
}

void InterfaceRows::add_velocity_change(std::size_t structure, std::span<const double> impulses,
                                        double* velocity) {
  pick(structure, impulses);
  traces_[structure].add_impulse(point_impulse_.data(), velocity);
}

double InterfaceRows::support_work(std::size_t structure, std::span<const double> impulses,
                                   std::span<const double> velocity) {
  pick(structure, impulses);
  return traces_[structure].support_work(point_impulse_, velocity);
}

}  // namespace pounding::interactions
