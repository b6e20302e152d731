#include "motion/stretch_jump.h"

#include "motion/oscillator_rest.h"

namespace pounding::oscillator {
namespace {

constexpr std::size_t vectors = OscillatorBlock::vectors;

/// A x in one vector of a block.
void multiply_by_state(const OscillatorBlock& block, std::size_t b, Octet& u, Octet& v) {
  const Octet none{};
  block.step(b, none, none, u, v);
}

}  // namespace

StretchJump::StretchJump(const OscillatorBlock& block) : weights_(stretch_size + 1) {
  for (std::size_t b = 0; b < vectors; ++b) {
    // A^j b_1 and A^j b_0, j = N - k.
    Octet u1 = block.B[0][1][b], v1 = block.B[1][1][b];
    Octet u0 = block.B[0][0][b], v0 = block.B[1][0][b];
    weights_[stretch_size].u[b] = u1;
    weights_[stretch_size].v[b] = v1;
    for (std::size_t k = stretch_size; k-- > 0;) {
      weights_[k].u[b] = u0;
      weights_[k].v[b] = v0;
      multiply_by_state(block, b, u1, v1);
      multiply_by_state(block, b, u0, v0);
      if (k > 0) {
        weights_[k].u[b] += u1;
        weights_[k].v[b] += v1;
      }
    }
    for (std::size_t column = 0; column < 2; ++column) {
      Octet u = all_octet(column == 0 ? 1 : 0), v = all_octet(column == 1 ? 1 : 0);
      for (std::size_t n = 0; n < stretch_size; ++n) multiply_by_state(block, b, u, v);
      state_[0][column][b] = u;
      state_[1][column][b] = v;
    }
  }
}

template <std::size_t count>
void StretchJump::add_loads(const double* first, BlockState* sums) const {
  Octet u[count][vectors]{}, v[count][vectors]{};
  for (std::size_t k = 0; k <= stretch_size; ++k) {
    const BlockState& weight = weights_[k];
    for (std::size_t s = 0; s < count; ++s) {
      const Octet a = all_octet(first[s * stretch_size + k]);
      for (std::size_t b = 0; b < vectors; ++b) {
        add_product(weight.u[b], a, u[s][b]);
        add_product(weight.v[b], a, v[s][b]);
      }
    }
  }
  for (std::size_t s = 0; s < count; ++s) {
    for (std::size_t b = 0; b < vectors; ++b) {
      sums[s].u[b] = u[s][b];
      sums[s].v[b] = v[s][b];
    }
  }
}

void StretchJump::find_starts(std::span<const double> acceleration, double h2,
                              std::span<const Stretch> stretches,
                              std::span<BlockState> states) const {
  if (stretches.empty()) return;
  constexpr std::size_t together = 4;
  const std::size_t jumps = stretches.size() - 1;  // the last stretch leads nowhere
  BlockState sums[together];
  const Octet scale = all_octet(h2);
  states[0] = {};
  for (std::size_t s = 0; s < jumps; ++s) {
    const std::size_t place = s % together;
    if (place == 0) {
      const double* const first = &acceleration[stretches[s].first];
      if (s + together <= jumps) {
        add_loads<together>(first, sums);
      } else {
        for (std::size_t i = 0; s + i < jumps; ++i) {
          add_loads<1>(first + i * stretch_size, sums + i);
        }
      }
    }
    for (std::size_t b = 0; b < vectors; ++b) {
      const Octet &u = states[s].u[b], &v = states[s].v[b];
      Octet u1 = scale * sums[place].u[b], v1 = scale * sums[place].v[b];
      add_product(state_[0][1][b], v, u1);
      add_product(state_[1][1][b], v, v1);
      add_product(state_[0][0][b], u, u1);
      add_product(state_[1][0][b], u, v1);
      come_to_rest(stretches[s].load, u1, v1);
      states[s + 1].u[b] = u1;
      states[s + 1].v[b] = v1;
    }
  }
}

}  // namespace pounding::oscillator
