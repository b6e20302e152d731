// Time of K w per dof: element by element against PETSc's assembled matrix without inodes (the
// faster of its two). Not part of the tests: a person runs it on a quiet machine, on one rank, and
// compares figures of one run only. Link with pounding_core and benchmark::benchmark.

#include <benchmark/benchmark.h>

#include <slepcsys.h>

#include "common/parallel.h"
#include "support/box_mesh.h"
#include "system/element_stiffness.h"
#include "system/finite_element_system.h"

namespace pounding {
namespace {

/// A slab or block of concrete of the given cells, with both products.
struct Block {
  explicit Block(const benchmark::State& state) {
    const std::array<int, 3> cells{static_cast<int>(state.range(0)),
                                   static_cast<int>(state.range(1)),
                                   static_cast<int>(state.range(2))};
    const GlobalMesh global =
        testing::box_mesh({0, 0, 0}, {0.25 * cells[0], 0.3 * cells[1], 0.22 * cells[2]}, cells);
    const Structure structure = testing::solid_structure("block", 30e9, 0.2, 2400);
    mesh =
        distribute_mesh(PETSC_COMM_SELF, "block", global, partition_meshes({&global, 1}, {}, 1), 0);
    system = build_finite_element_system(structure, mesh);
    stiffness = std::make_unique<ElementStiffness>(structure, mesh, std::move(system.stiffness));
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
  std::unique_ptr<ElementStiffness> stiffness;
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

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"x", "y", "z"});
  benchmark->Args({28, 19, 1})->Args({18, 19, 1})->Args({77, 77, 1})->Args({46, 46, 46});
  benchmark->Unit(benchmark::kMicrosecond);
}

BENCHMARK(element_product)->Apply(sizes);
BENCHMARK(assembled_product)->Apply(sizes);

}  // namespace
}  // namespace pounding

int main(int count, char** words) {
  benchmark::Initialize(&count, words);
  SlepcInitialize(&count, &words, nullptr, nullptr);
  benchmark::RunSpecifiedBenchmarks();
  SlepcFinalize();
}
