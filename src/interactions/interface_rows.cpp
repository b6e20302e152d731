#include "interactions/interface_rows.h"

#include <algorithm>
#include <set>

#include "common/parallel.h"

namespace pounding::interactions {
namespace {

/// Values that are reduced through common memory; more travel in a message.
constexpr std::size_t most_reduced = 64;

}  // namespace

InterfaceGather::InterfaceGather(MPI_Comm comm, std::span<const int> mine, bool common_memory) {
  int lowest = mine.empty() ? size_of(comm) : rank_of(comm);
  MPI_Allreduce(&lowest, &root_, 1, MPI_INT, MPI_MIN, comm);
  int counts = mine.empty() ? 0 : 1;
  MPI_Allreduce(&counts, &members_, 1, MPI_INT, MPI_SUM, comm);
  MPI_Comm_split(comm, mine.empty() ? MPI_UNDEFINED : 0, rank_of(comm), &comm_);
  if (!member()) return;
  const std::vector<int> own(mine.begin(), mine.end());
  const std::vector<int> sizes = gather_rows(comm_, std::vector<int>{static_cast<int>(own.size())});
  const std::vector<int> all = gather_rows(comm_, own);
  auto next = all.begin();
  for (const int size : sizes) {
    known_.emplace_back(next, next + size);
    next += size;
  }
  if (common_memory && members_ > 1) {
    shared_ = std::make_unique<SharedExchange>(comm_, own.size() * max_fields);
    sums_ = std::make_unique<SharedExchange>(comm_, most_reduced);
    if (!shared_->works() || !sums_->works()) {
      shared_.reset();
      sums_.reset();
    }
  }
  want(all);
}

InterfaceGather::~InterfaceGather() {
  if (member()) MPI_Comm_free(&comm_);
}

void InterfaceGather::want(std::span<const int> dofs) {
  const std::set<int> wanted(dofs.begin(), dofs.end());
  std::vector<Partner> others;
  for (int m = 0; m < members_; ++m) {
    Partner& other = others.emplace_back(Partner{m, {}, {}, {}, {}, {}});
    for (std::size_t k = 0; m != rank_of(comm_) && k < known_[m].size(); ++k) {
      if (!wanted.contains(known_[m][k])) continue;
      other.dofs.push_back(known_[m][k]);
      other.places.push_back(static_cast<int>(k));
    }
  }
  partners_.clear();
  for (int turn = 0; turn < members_; ++turn) {  // every pair once, each with itself too
    const int with = (turn - rank_of(comm_) + members_) % members_;
    Partner& other = others[with];
    int give = static_cast<int>(other.places.size()), take = 0;
    MPI_Sendrecv(&give, 1, MPI_INT, with, 0, &take, 1, MPI_INT, with, 0, comm_, MPI_STATUS_IGNORE);
    other.wants.resize(take);
    MPI_Sendrecv(other.places.data(), give, MPI_INT, with, 0, other.wants.data(), take, MPI_INT,
                 with, 0, comm_, MPI_STATUS_IGNORE);
    if (give + take == 0) continue;
    other.taken.resize(shared_ ? 0 : max_fields * other.places.size());
    other.sent.resize(shared_ ? 0 : max_fields * other.wants.size());
    partners_.push_back(std::move(other));
  }
  requests_.resize(2 * partners_.size());
}

void InterfaceGather::exchange_messages(int fields, std::span<const double> mine) {
  const auto width = static_cast<std::size_t>(fields);
  for (std::size_t p = 0; p < partners_.size(); ++p) {
    Partner& other = partners_[p];
    MPI_Irecv(other.taken.data(), fields * static_cast<int>(other.places.size()), MPI_DOUBLE,
              other.rank, 0, comm_, &requests_[2 * p]);
    double* next = other.sent.data();
    for (const int place : other.wants) next = std::copy_n(&mine[width * place], width, next);
    MPI_Isend(other.sent.data(), fields * static_cast<int>(other.wants.size()), MPI_DOUBLE,
              other.rank, 0, comm_, &requests_[2 * p + 1]);
  }
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

void InterfaceGather::gather(int fields, std::span<const double> mine, std::span<double> all) {
  const auto width = static_cast<std::size_t>(fields);
  const std::size_t dofs = all.size() / width;
  if (shared_) {
    shared_->publish(mine);
  } else {
    exchange_messages(fields, mine);
  }
  const std::vector<int>& own = known_[rank_of(comm_)];
  for (std::size_t f = 0; f < width; ++f) {
    for (std::size_t k = 0; k < own.size(); ++k) all[f * dofs + own[k]] = mine[width * k + f];
  }
  for (const Partner& other : partners_) {
    const double* const theirs = shared_ ? shared_->wait_for(other.rank) : other.taken.data();
    for (std::size_t k = 0; k < other.dofs.size(); ++k) {
      const double* const values = theirs + width * (shared_ ? other.places[k] : k);
      for (std::size_t f = 0; f < width; ++f) all[f * dofs + other.dofs[k]] = values[f];
    }
  }
}

void InterfaceGather::agree(std::span<double> sums, std::span<double> least) {
  if (members_ == 1) return;
  if (!sums_ || sums.size() + least.size() > most_reduced) {
    if (!sums.empty()) reduce_over_ranks(comm_, MPI_SUM, sums);
    if (!least.empty()) reduce_over_ranks(comm_, MPI_MIN, least);
    return;
  }
  std::copy(least.begin(), least.end(), std::copy(sums.begin(), sums.end(), sums_->draft()));
  sums_->publish();
  for (int m = 0; m < members_; ++m) {
    const double* theirs = sums_->wait_for(m);
    for (double& sum : sums) sum = m == 0 ? *theirs++ : sum + *theirs++;
    for (double& value : least) value = m == 0 ? *theirs++ : std::min(value, *theirs++);
  }
}

void share_rows(MPI_Comm comm, std::span<const int> counted, std::size_t width,
                std::span<double> values) {
  if (comm == MPI_COMM_NULL || size_of(comm) == 1) return;
  std::vector<double> own(values.size(), 0.0);
  for (const int row : counted) std::copy_n(&values[width * row], width, &own[width * row]);
  reduce_over_ranks(comm, MPI_SUM, own);
  std::ranges::copy(own, values.begin());
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
      compliance_(comm, structure_dofs_, traces_) {
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
