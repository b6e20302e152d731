#include "system/brick_lines.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace pounding {
namespace {

/// Dofs whose forces, masses and motion stay in the nearest cache while they are handed over.
constexpr LocalIndex most_united = 400;

ComponentArrays shifted(const ComponentArrays& arrays, int nodes) {
  return {arrays.x + nodes, arrays.y + nodes, arrays.z + nodes};
}

/// Nodes that stay where they are.
void set_clamped(const ComponentArrays& to, int begin, int end, const StiffnessArgument& w) {
  std::fill(to.x + begin, to.x + end, -w.origin[0]);
  std::fill(to.y + begin, to.y + end, -w.origin[1]);
  std::fill(to.z + begin, to.z + end, -w.origin[2]);
}

int round_up(int count) {
  return (count + lane_count - 1) / lane_count * lane_count;
}

}  // namespace

BrickLines::BrickLines(const DofPlaces& places, const Matrix3& axes,
                       const std::vector<BrickShape>& shapes, const BrickRows& rows)
    : owned_dofs_(places.owned_dofs) {
  const BrickPairs pairs = pair_chains(rows);
  rotated_ = axes != Matrix3{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(pairs.axes[d]);
    axes_[d] = axes[axis];
    component_[rotated_ ? d : axis] = static_cast<int>(d);
  }
  for (const BrickShape& shape : shapes) {
    Vector3 lengths{};
    for (std::size_t d = 0; d < 3; ++d) {
      lengths[d] = shape.lengths[static_cast<std::size_t>(pairs.axes[d])];
    }
    const auto split = split_brick(shape.type, shape.properties, lengths);
    if (!split) throw std::logic_error("BrickLines: a shape that does not split");
    stencils_.push_back(brick_stencil(*split));
  }
  std::vector<ChainForm> forms;
  for (const auto& nodes : rows.chains) {
    const BrickChain& chain = chains_.add(places, nodes);
    forms.push_back({chain.length, chain.whole_row()});
    line_stride_ = std::max(line_stride_, round_up(chain.length + lane_count));
  }
  schedule_ = schedule_lines(pairs, forms, line_stride_);
  for (const ChainStore& store : schedule_.stores) stores_.push_back({store, Outcome::add, 0, 0});
  deferred_.assign(schedule_.joins.size(), 0);
  buffer_.assign(static_cast<std::size_t>(schedule_.buffer_size), 0.0);
}

ComponentArrays BrickLines::displacements(int start) const {
  double* const line = buffer_.data() + start;
  return {line + component_[0] * line_stride_, line + component_[1] * line_stride_,
          line + component_[2] * line_stride_};
}

ComponentArrays BrickLines::forces(int start) const {
  return displacements(start + 3 * line_stride_);
}

void BrickLines::clear_forces(int start, int length) const {
  for (int c = 3; c < 6; ++c) {
    double* const force = buffer_.data() + start + c * line_stride_;
    for (int p = 0; p < length; p += lane_count) store(force + p, Lanes{});
  }
}

void BrickLines::load_chain(const ChainLoad& load, const StiffnessArgument& w,
                            const double* ghosts) const {
  const BrickChain& chain = chains_.at(load.chain);
  const LocalIndex* const place = chains_.places(chain);
  const ComponentArrays to = displacements(load.start);
  if (chain.plain || chain.ghost_row >= 0) {
    const ComponentArrays moving = shifted(to, chain.first);
    if (chain.ghost_row >= 0) {
      load_row({ghosts, ghosts, 0, w.origin}, chain.ghost_row, chain.moving, moving);
    } else if (chain.row) {
      load_row(w, place[0], chain.moving, moving);
    } else {
      load_nodes(w, place, chain.moving, moving);
    }
    set_clamped(to, 0, chain.first, w);
    set_clamped(to, chain.first + chain.moving, chain.length, w);
  } else {
    for (int p = 0; p < chain.length; ++p) {
      to.x[p] = value_at(place[3 * p], owned_dofs_, w, ghosts) - w.origin[0];
      to.y[p] = value_at(place[3 * p + 1], owned_dofs_, w, ghosts) - w.origin[1];
      to.z[p] = value_at(place[3 * p + 2], owned_dofs_, w, ghosts) - w.origin[2];
    }
  }
  for (int p = chain.length; p < round_up(chain.length); ++p) to.x[p] = to.y[p] = to.z[p] = 0;
  if (rotated_) {
    rotate_vectors(axes_, false, chain.length, line_stride_, buffer_.data() + load.start);
  }
  if (load.clear) clear_forces(load.start, chain.length);
}

void BrickLines::split_chains(const PairSplit& split, const StiffnessArgument& w) const {
  const PairPlace& place = split.place;
  double* const buffer = buffer_.data();
  if (split.load) {
    const std::array<LocalIndex, 2> first{chains_.places(chains_.at(place.chain[0]))[0],
                                          chains_.places(chains_.at(place.chain[1]))[0]};
    load_row_pair(w, first, place.length, displacements(place.line[0]),
                  displacements(place.line[1]));
    for (std::size_t i = 0; rotated_ && i < 2; ++i) {
      rotate_vectors(axes_, false, place.length, line_stride_, buffer + place.line[i]);
    }
  } else {
    split_pair(buffer + place.node[0], buffer + place.node[1], place.length, line_stride_,
               {buffer + place.line[0], buffer + place.line[1]});
  }
  if (split.clear) {
    clear_forces(place.line[0], place.length);
    clear_forces(place.line[1], place.length);
  }
}

void BrickLines::apply_step(const LineStep& step) const {
  std::array<PairLine, 3> lines;
  for (std::size_t i = 0; i < 3; ++i) {
    lines[i] = {buffer_.data() + step.start[i][0], buffer_.data() + step.start[i][1]};
  }
  add_line_forces(stencils_[static_cast<std::size_t>(step.shape)], step.sides, step.first_behind,
                  lines[0], lines[1], lines[2], line_stride_, step.count);
}

void BrickLines::join_chains(std::size_t join) const {
  const auto& [place, first] = schedule_.joins[join];
  double* const buffer = buffer_.data();
  if (deferred_[join] == 0) {
    join_pair({buffer + place.line[0], buffer + place.line[1]}, place.length, line_stride_, first,
              buffer + place.node[0], buffer + place.node[1]);
    return;
  }
  for (std::size_t i = 0; rotated_ && i < 2; ++i) {
    rotate_vectors(axes_, true, place.length, line_stride_,
                   buffer + place.line[i] + 3 * line_stride_);
  }
}

void BrickLines::add_forces(const Store& store, double* q) const {
  const BrickChain& chain = chains_.at(store.place.chain);
  if (!chain.range.empty()) {
    const LocalIndex size = chain.range.end - chain.range.begin;
    if (!chain.row) std::fill(added_.begin(), added_.begin() + size, 0.0);
    collect_forces(store, added_.data());
    for (LocalIndex i = 0; i < size; ++i) {
      q[chain.range.begin + i] += added_[static_cast<std::size_t>(i)];
    }
    return;
  }
  const ComponentArrays force = forces(store.place.start);
  const std::array<const double*, 3> component{force.x, force.y, force.z};
  for (int p = 0; p < chain.length; ++p) {
    for (int c = 0; c < 3; ++c) {
      const LocalIndex dof = chains_.place(chain, p, c);
      if (dof >= 0 && dof < owned_dofs_) q[dof] += component[static_cast<std::size_t>(c)][p];
    }
  }
}

/// Forces of a chain with a range, that of its first dof to range[0].
void BrickLines::collect_forces(const Store& store, double* range) const {
  const BrickChain& chain = chains_.at(store.place.chain);
  const bool lent = store.place.join >= 0;
  if (lent && deferred_[static_cast<std::size_t>(store.place.join)] != 0) {
    const PairPlace& pair = schedule_.joins[static_cast<std::size_t>(store.place.join)].place;
    const bool near = pair.chain[0] == store.place.chain;
    (near ? store_near_row : store_far_row)(forces(pair.line[0]), forces(pair.line[1]),
                                            chain.length, range);
    return;
  }
  const ComponentArrays moving = shifted(forces(store.place.start), chain.first);
  if (chain.row) {
    store_row(moving, chain.moving, range);
  } else {
    store_nodes(moving, chains_.places(chain), chain.moving, chain.range.begin, range);
  }
}

void BrickLines::store_chain(const Store& store, double* q, ForceReceiver& receiver) const {
  const auto& [place, outcome, begin, end] = store;
  const BrickChain& chain = chains_.at(place.chain);
  const bool deferred = place.join >= 0 && deferred_[static_cast<std::size_t>(place.join)] != 0;
  if (rotated_ && !deferred) {
    rotate_vectors(axes_, true, chain.length, line_stride_,
                   buffer_.data() + place.start + 3 * line_stride_);
  }
  if (outcome == Outcome::add) {
    if (chain.ghost_row < 0) add_forces(store, q);
    return;
  }
  double* const range = range_.data() + (chain.range.begin - begin);
  const LocalIndex size = chain.range.end - chain.range.begin;
  if (outcome == Outcome::complete) std::fill(range, range + size, 0.0);
  collect_forces(store, range);
  if (outcome == Outcome::complete) {
    double* const already = q + chain.range.begin;
    for (LocalIndex i = 0; i < size; ++i) range[i] += already[i];
    std::fill(already, already + size, 0.0);
  }
  if (end > 0) receiver.receive(begin, end, range_.data());
}

void BrickLines::apply(const StiffnessArgument& w, const double* ghosts, double* q,
                       ForceReceiver& receiver) const {
  std::size_t loaded = 0;
  std::size_t split = 0;
  std::size_t joined = 0;
  std::size_t stored = 0;
  for (const LineStep& step : schedule_.steps) {
    while (loaded < step.loads_end) load_chain(schedule_.loads[loaded++], w, ghosts);
    while (split < step.splits_end) split_chains(schedule_.splits[split++], w);
    apply_step(step);
    while (joined < step.joins_end) join_chains(joined++);
    while (stored < step.stores_end) store_chain(stores_[stored++], q, receiver);
  }
}

std::vector<LocalIndex> BrickLines::chain_dofs(std::size_t number) const {
  const BrickChain& chain = chains_.at(stores_[number].place.chain);
  std::vector<LocalIndex> dofs;
  for (int p = 0; p < chain.length; ++p) {
    for (int c = 0; c < 3; ++c) {
      const LocalIndex dof = chains_.place(chain, p, c);
      if (dof >= 0 && dof < owned_dofs_) dofs.push_back(dof);
    }
  }
  return dofs;
}

DofRange BrickLines::chain_range(std::size_t place) const {
  return chains_.at(stores_[place].place.chain).range;
}

void BrickLines::set_outcomes(const std::vector<Outcome>& outcomes) {
  for (std::size_t s = 0; s < stores_.size(); ++s) stores_[s].outcome = outcomes[s];
  find_deferred();
  std::size_t begin = 0;
  for (const LineStep& step : schedule_.steps) {
    sort_stores(begin, step.stores_end);
    begin = step.stores_end;
  }
  unite_ranges();
}

/// Rows of one pair need not be joined before they are stored, if both are handed over.
void BrickLines::find_deferred() {
  std::vector<int> rows(deferred_.size(), 0);
  for (const Store& store : stores_) {
    if (store.place.join < 0 || store.outcome == Outcome::add) continue;
    if (chains_.at(store.place.chain).whole_row())
      ++rows[static_cast<std::size_t>(store.place.join)];
  }
  for (std::size_t j = 0; j < rows.size(); ++j) deferred_[j] = rows[j] == 2 ? 1 : 0;
}

/// Those of one step, in the order of their dofs.
void BrickLines::sort_stores(std::size_t begin, std::size_t end) {
  const auto first_of = [this](const Store& store) {
    return chains_.at(store.place.chain).range.begin;
  };
  std::stable_sort(stores_.begin() + static_cast<std::ptrdiff_t>(begin),
                   stores_.begin() + static_cast<std::ptrdiff_t>(end),
                   [&](const Store& a, const Store& b) { return first_of(a) < first_of(b); });
}

/// The last one of the stores whose ranges are united hands all of them over.
void BrickLines::unite_ranges() {
  Store* last = nullptr;
  for (Store& store : stores_) {
    const DofRange range = chains_.at(store.place.chain).range;
    if (store.outcome == Outcome::add) {
      const auto size = static_cast<std::size_t>(range.end - range.begin);
      if (added_.size() < size) added_.resize(size, 0.0);
      continue;
    }
    store.begin = range.begin;
    store.end = range.end;
    if (last != nullptr && last->end == range.begin && range.end - last->begin <= most_united) {
      store.begin = last->begin;
      last->end = 0;
    }
    last = &store;
    const auto size = static_cast<std::size_t>(store.end - store.begin) + lane_count;
    if (range_.size() < size) range_.resize(size, 0.0);
  }
}

}  // namespace pounding
