#include "system/brick_lines.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "system/brick_kernel.h"
#include "system/lanes.h"

namespace pounding {
namespace {

constexpr int arrays_per_line = 6;

/// The argument at four dofs in a row.
inline void load_argument(const StiffnessArgument& w, LocalIndex dof, Lanes& values) {
  Lanes velocity;
  load(w.displacement + dof, values);
  load(w.velocity + dof, velocity);
  values += w.beta * velocity;
}

/// x, y, z of four nodes whose dofs start at w[place[0..3]], into three arrays. Reads one value
/// beyond each node.
inline void load_four(const StiffnessArgument& w, const LocalIndex* place, double* x, double* y,
                      double* z) {
  Lanes a, b, c, d;
  load_argument(w, place[0], a);
  load_argument(w, place[1], b);
  load_argument(w, place[2], c);
  load_argument(w, place[3], d);
  const Lanes xz_ab = __builtin_shuffle(a, b, LaneMask{0, 4, 2, 6});
  const Lanes xz_cd = __builtin_shuffle(c, d, LaneMask{0, 4, 2, 6});
  const Lanes y_ab = __builtin_shuffle(a, b, LaneMask{1, 5, 3, 7});
  const Lanes y_cd = __builtin_shuffle(c, d, LaneMask{1, 5, 3, 7});
  store(x, __builtin_shuffle(xz_ab, xz_cd, LaneMask{0, 1, 4, 5}));
  store(y, __builtin_shuffle(y_ab, y_cd, LaneMask{0, 1, 4, 5}));
  store(z, __builtin_shuffle(xz_ab, xz_cd, LaneMask{2, 3, 6, 7}));
}

/// The way back, dof `first` standing at q[0].
inline void store_four(const double* x, const double* y, const double* z, const LocalIndex* place,
                       LocalIndex first, double* q) {
  Lanes a, b;
  load(x, a);
  load(y, b);
  const Lanes even = __builtin_shuffle(a, b, LaneMask{0, 4, 2, 6});
  const Lanes odd = __builtin_shuffle(a, b, LaneMask{1, 5, 3, 7});
  std::memcpy(q + (place[0] - first), &even, sizeof(HalfLanes));
  std::memcpy(q + (place[1] - first), &odd, sizeof(HalfLanes));
  const Lanes even_far = __builtin_shuffle(even, LaneMask{2, 3, 0, 1});
  const Lanes odd_far = __builtin_shuffle(odd, LaneMask{2, 3, 0, 1});
  std::memcpy(q + (place[2] - first), &even_far, sizeof(HalfLanes));
  std::memcpy(q + (place[3] - first), &odd_far, sizeof(HalfLanes));
  for (int i = 0; i < 4; ++i) q[place[i] - first + 2] = z[i];
}

/// Values v <- R v, or R' v, of a line's three arrays.
void rotate_line(const Matrix3& axes, bool back, double* values, int stride, int length) {
  double* const x = values;
  double* const y = values + stride;
  double* const z = values + 2 * stride;
  Matrix3 r = axes;
  if (back) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) r[i][j] = axes[j][i];
  }
  for (int p = 0; p < length; ++p) {
    const Vector3 v = multiply(r, {x[p], y[p], z[p]});
    x[p] = v[0];
    y[p] = v[1];
    z[p] = v[2];
  }
}

}  // namespace

BrickLines::BrickLines(const DofPlaces& places, const Matrix3& axes,
                       const std::vector<BrickShape>& shapes, const BrickRows& rows)
    : owned_dofs_(places.owned_dofs) {
  const auto run_axis = static_cast<std::size_t>(rows.run_axis);
  rotated_ = axes != Matrix3{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};
  for (std::size_t d = 0; d < 3; ++d) {
    axes_[d] = axes[(run_axis + d) % 3];
    component_[d] = static_cast<int>(rotated_ ? d : (d + 3 - run_axis) % 3);
  }
  for (const BrickShape& shape : shapes) {
    const auto split = split_brick(shape.type, shape.properties, shape.lengths, rows.run_axis);
    if (!split) throw std::logic_error("BrickLines: a shape that does not split");
    splits_.push_back(*split);
  }
  for (const auto& nodes : rows.chains) add_chain(places, nodes);
  schedule(rows);
}

void BrickLines::add_chain(const DofPlaces& places, const std::vector<LocalIndex>& nodes) {
  Chain chain{static_cast<int>(places_.size()), static_cast<int>(nodes.size()), true, {}};
  bool contiguous = true;
  for (const LocalIndex node : nodes) {
    const auto n = static_cast<std::size_t>(node);
    const auto& [x, y, z] = places.of_node[n];
    chain.plain = chain.plain && x >= 0 && y == x + 1 && z == x + 2 && z + 1 < owned_dofs_;
    contiguous = contiguous && chain.plain && (node == nodes[0] || x == chain.range.end);
    if (contiguous) chain.range = {node == nodes[0] ? x : chain.range.begin, places.node_end[n]};
  }
  if (!contiguous) chain.range = {};
  for (const LocalIndex node : nodes) {
    const auto& place = places.of_node[static_cast<std::size_t>(node)];
    places_.insert(places_.end(), place.begin(), chain.plain ? place.begin() + 1 : place.end());
  }
  chains_.push_back(chain);
  line_stride_ = std::max(line_stride_, (chain.length + 2 * lane_count) / lane_count * lane_count);
}

/// Gives each chain a line of the buffer from its first run to its last one.
void BrickLines::schedule(const BrickRows& rows) {
  std::vector<int> uses(rows.chains.size(), 0);
  for (const BrickRun& run : rows.runs) {
    for (const int chain : run.chain) ++uses[static_cast<std::size_t>(chain)];
  }
  std::vector<int> start(rows.chains.size(), -1);
  std::vector<int> free_lines;
  int lines = 0;
  const int line_size = arrays_per_line * line_stride_;
  for (const BrickRun& row : rows.runs) {
    Run run{row.shape, row.count, {}, 0, 0};
    for (std::size_t l = 0; l < 4; ++l) {
      const auto chain = static_cast<std::size_t>(row.chain[l]);
      if (start[chain] < 0) {
        if (free_lines.empty()) free_lines.push_back(lines++ * line_size);
        start[chain] = free_lines.back();
        free_lines.pop_back();
        loads_.push_back({row.chain[l], start[chain]});
      }
      run.start[l] = start[chain] + row.offset[l];
    }
    for (const int chain : row.chain) {
      if (--uses[static_cast<std::size_t>(chain)] == 0) {
        stores_.push_back({chain, start[static_cast<std::size_t>(chain)]});
        free_lines.push_back(stores_.back().start);
      }
    }
    run.loads_end = static_cast<int>(loads_.size());
    run.stores_end = static_cast<int>(stores_.size());
    runs_.push_back(run);
  }
  buffer_.assign(static_cast<std::size_t>(lines * line_size), 0.0);
}

void BrickLines::load_chain(const Transfer& transfer, const StiffnessArgument& w,
                            const double* ghosts) const {
  const Chain& chain = chains_[static_cast<std::size_t>(transfer.chain)];
  const LocalIndex* const place = places_.data() + chain.begin;
  double* const line = buffer_.data() + transfer.start;
  double* const x = line + component_[0] * line_stride_;
  double* const y = line + component_[1] * line_stride_;
  double* const z = line + component_[2] * line_stride_;
  if (chain.plain) {
    int p = 0;
    for (; p + 4 <= chain.length; p += 4) load_four(w, place + p, x + p, y + p, z + p);
    for (; p < chain.length; ++p) {
      x[p] = w[place[p]];
      y[p] = w[place[p] + 1];
      z[p] = w[place[p] + 2];
    }
  } else {
    for (int p = 0; p < chain.length; ++p) {
      x[p] = value_at(place[3 * p], owned_dofs_, w, ghosts);
      y[p] = value_at(place[3 * p + 1], owned_dofs_, w, ghosts);
      z[p] = value_at(place[3 * p + 2], owned_dofs_, w, ghosts);
    }
  }
  if (rotated_) rotate_line(axes_, false, line, line_stride_, chain.length);
  for (int c = 3; c < arrays_per_line; ++c) {
    double* const force = line + c * line_stride_;
    for (int p = 0; p < chain.length; p += lane_count) store(force + p, Lanes{});
  }
}

void BrickLines::add_forces(const Chain& chain, const std::array<const double*, 3>& force,
                            double* q) const {
  const LocalIndex* const place = places_.data() + chain.begin;
  for (int p = 0; p < chain.length; ++p) {
    for (int c = 0; c < 3; ++c) {
      const LocalIndex dof = chain.plain ? place[p] + c : place[3 * p + c];
      if (dof >= 0 && dof < owned_dofs_) q[dof] += force[static_cast<std::size_t>(c)][p];
    }
  }
}

void BrickLines::store_chain(const Transfer& transfer, double* q, ForceReceiver& receiver) const {
  const Chain& chain = chains_[static_cast<std::size_t>(transfer.chain)];
  double* const line = buffer_.data() + transfer.start + 3 * line_stride_;
  if (rotated_) rotate_line(axes_, true, line, line_stride_, chain.length);
  const std::array<const double*, 3> force{line + component_[0] * line_stride_,
                                           line + component_[1] * line_stride_,
                                           line + component_[2] * line_stride_};
  if (transfer.outcome == Outcome::add) {
    add_forces(chain, force, q);
    return;
  }
  const LocalIndex* const place = places_.data() + chain.begin;
  const LocalIndex first = transfer.begin;
  if (transfer.outcome == Outcome::complete) {
    std::fill(range_.begin() + (chain.range.begin - first),
              range_.begin() + (chain.range.end - first), 0.0);
  }
  int p = 0;
  for (; p + 4 <= chain.length; p += 4) {
    store_four(force[0] + p, force[1] + p, force[2] + p, place + p, first, range_.data());
  }
  for (; p < chain.length; ++p) {
    double* const node = range_.data() + (place[p] - first);
    for (std::size_t c = 0; c < 3; ++c) node[c] = force[c][p];
  }
  if (transfer.outcome == Outcome::complete) complete_range(transfer, q);
  if (transfer.end > 0) receiver.receive(first, transfer.end, range_.data());
}

/// Moves what q holds of a chain's nodes to their forces.
void BrickLines::complete_range(const Transfer& transfer, double* q) const {
  const DofRange& range = chains_[static_cast<std::size_t>(transfer.chain)].range;
  double* const force = range_.data() + (range.begin - transfer.begin);
  for (LocalIndex i = 0; i < range.end - range.begin; ++i) {
    force[i] += q[range.begin + i];
    q[range.begin + i] = 0;
  }
}

void BrickLines::apply(const StiffnessArgument& w, const double* ghosts, double* q,
                       ForceReceiver& receiver) const {
  std::size_t loaded = 0;
  std::size_t stored = 0;
  for (const Run& run : runs_) {
    for (; loaded < static_cast<std::size_t>(run.loads_end); ++loaded) {
      load_chain(loads_[loaded], w, ghosts);
    }
    std::array<BrickLine, 4> lines;
    for (std::size_t l = 0; l < 4; ++l) {
      double* const start = buffer_.data() + run.start[l];
      lines[l] = {start, start + 3 * line_stride_};
    }
    add_brick_run(splits_[static_cast<std::size_t>(run.split)], lines, line_stride_, run.count);
    for (; stored < static_cast<std::size_t>(run.stores_end); ++stored) {
      store_chain(stores_[stored], q, receiver);
    }
  }
}

std::vector<LocalIndex> BrickLines::chain_dofs(std::size_t place) const {
  const Chain& chain = chains_[static_cast<std::size_t>(stores_[place].chain)];
  std::vector<LocalIndex> dofs;
  for (int p = 0; p < chain.length; ++p) {
    for (int c = 0; c < 3; ++c) {
      const auto at = static_cast<std::size_t>(chain.begin + (chain.plain ? p : 3 * p + c));
      const LocalIndex dof = places_[at] < 0 ? -1 : places_[at] + (chain.plain ? c : 0);
      if (dof >= 0 && dof < owned_dofs_) dofs.push_back(dof);
    }
  }
  return dofs;
}

DofRange BrickLines::chain_range(std::size_t place) const {
  return chains_[static_cast<std::size_t>(stores_[place].chain)].range;
}

void BrickLines::set_outcomes(const std::vector<Outcome>& outcomes) {
  const auto range_of = [this](const Transfer& store) {
    return chains_[static_cast<std::size_t>(store.chain)].range;
  };
  for (std::size_t s = 0; s < stores_.size(); ++s) stores_[s].outcome = outcomes[s];
  LocalIndex longest = 0;
  std::size_t begin = 0;
  for (const Run& run : runs_) {
    const auto end = static_cast<std::size_t>(run.stores_end);
    std::stable_sort(stores_.begin() + static_cast<std::ptrdiff_t>(begin),
                     stores_.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](const Transfer& a, const Transfer& b) {
                       return range_of(a).begin < range_of(b).begin;
                     });
    for (std::size_t s = begin; s < end; ++s) {
      Transfer& store = stores_[s];
      if (store.outcome == Outcome::add) continue;
      store.begin = range_of(store).begin;
      store.end = range_of(store).end;
      if (s > begin && stores_[s - 1].end > 0 && stores_[s - 1].end == store.begin) {
        store.begin = stores_[s - 1].begin;
        stores_[s - 1].end = 0;
      }
      longest = std::max(longest, store.end - store.begin);
    }
    begin = end;
  }
  range_.assign(static_cast<std::size_t>(longest) + lane_count, 0.0);
}

}  // namespace pounding
