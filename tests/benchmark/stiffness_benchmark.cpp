// Time of K w per dof: element by element against PETSc's assembled matrix without inodes (the
// faster of its two), and of the bricks' kernel per brick in the nearest cache. Not part of the
// tests: a person runs it on a quiet machine, on one rank, and compares figures of one run only.
// Link with pounding_core and benchmark::benchmark.

#include <benchmark/benchmark.h>

#include <slepcsys.h>

#include "common/parallel.h"
#include "stiffness/bricks/brick_kernel.h"
#include "stiffness/element_stiffness.h"
#include "support/box_mesh.h"
#include "support/frame_mesh.h"
#include "system/finite_element_system.h"

namespace pounding {
namespace {

/// A slab or block of bricks of the given cells, or a plate of shells if there are none along z, of
/// concrete, with both products.
struct Block {
  explicit Block(const benchmark::State& state) {
    const std::array<int, 3> cells{static_cast<int>(state.range(0)),
                                   static_cast<int>(state.range(1)),
                                   static_cast<int>(state.range(2))};
    if (cells[2] == 0) {
      testing_support::FrameMesh plate;
      plate.add_plate({0, 0, 0}, {0.25 * cells[0], 0, 0}, {0, 0.3 * cells[1], 0},
                      {cells[0], cells[1]}, 0.22);
      build(plate.mesh(), plate.structure());
    } else {
      build(testing_support::box_mesh({0, 0, 0}, {0.25 * cells[0], 0.3 * cells[1], 0.22 * cells[2]},
                                      cells),
            testing_support::solid_structure("block", 30e9, 0.2, 2400));
    }
  }

  void build(const GlobalMesh& global, const Structure& structure) {
    mesh =
        distribute_mesh(PETSC_COMM_SELF, "block", global, partition_meshes({&global, 1}, {}, 1), 0);
    system = build_finite_element_system(structure, mesh);
    stiffness =
        std::make_unique<stiffness::ElementStiffness>(structure, mesh, std::move(system.stiffness));
    w.resize(system.lumped_mass.size());
    q.resize(w.size());
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = 1e-3 * static_cast<double>(i * 7919 % 1013);
    argument = wrap_vector(system, w);
    force = wrap_vector(system, q);
  }

  void report(benchmark::State& state) const {
    using benchmark::Counter;
    state.counters["per_dof"] = Counter(static_cast<double>(w.size()),
                                        Counter::kIsIterationInvariantRate | Counter::kInvert);
  }

  Mesh mesh;
  LinearSystem system;
  std::unique_ptr<stiffness::ElementStiffness> stiffness;
  std::vector<double> w;
  std::vector<double> q;
  VecHandle argument;
  VecHandle force;
};

void element_product(benchmark::State& state) {
  const Block block(state);
  for (auto _ : state) block.stiffness->apply(block.argument.get(), block.force.get());
  block.report(state);
}

void assembled_product(benchmark::State& state) {
  const Block block(state);
  for (auto _ : state) {
    POUNDING_PETSC(MatMult(block.stiffness->matrix(), block.argument.get(), block.force.get()));
  }
  block.report(state);
}

/// The middle one of three lines of pairs, with bricks on both sides.
void brick_kernel(benchmark::State& state) {
  const auto count = static_cast<int>(state.range(0));
  const std::ptrdiff_t stride = (count + 2 * most_lanes) / most_lanes * most_lanes;
  ElementProperties concrete{.young = 30e9, .poisson = 0.2, .density = 2400};
  const auto split = stiffness::split_brick(ElementType::hex8, concrete, {0.25, 0.3, 0.22});
  const stiffness::BrickStencil stencil = stiffness::brick_stencil(split.value());
  std::vector<double> memory(static_cast<std::size_t>(36 * stride), 1e-3);
  std::array<stiffness::PairLine, 3> lines;
  for (std::size_t l = 0; l < 3; ++l) {
    double* const line = memory.data() + static_cast<std::ptrdiff_t>(l) * 12 * stride;
    lines[l] = {line, line + 6 * stride};
  }
  for (auto _ : state) {
    stiffness::add_line_forces(stencil, stiffness::Sides::both, true, lines[1], lines[0], lines[2],
                               stride, count);
    benchmark::ClobberMemory();
  }
  using benchmark::Counter;
  state.counters["per_brick"] =
      Counter(count, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"x", "y", "z"});
  benchmark->Args({28, 19, 0})->Args({77, 77, 0});
  benchmark->Args({28, 19, 1})->Args({18, 19, 1})->Args({77, 77, 1})->Args({46, 46, 46});
  benchmark->Unit(benchmark::kMicrosecond);
}

BENCHMARK(element_product)->Apply(sizes);
BENCHMARK(assembled_product)->Apply(sizes);
BENCHMARK(brick_kernel)->ArgName("count")->Arg(1)->Arg(5)->Arg(18)->Arg(77)->Arg(200);

}  // namespace
}  // namespace pounding

int main(int count, char** words) {
  benchmark::Initialize(&count, words);
  SlepcInitialize(&count, &words, nullptr, nullptr);
  benchmark::RunSpecifiedBenchmarks();
  SlepcFinalize();
}
