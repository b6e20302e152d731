#include <array>
#include <map>
#include <stdexcept>

#include "benchmark/timed_step.h"

namespace pounding::measuring {
namespace {

constexpr PetscInt block = 3;

/// The entries of a row of blocks, one block column after the other.
using BlockRow = std::map<PetscInt, std::array<std::array<double, block>, block>>;

BlockRow read_block_row(Mat matrix, PetscInt block_row) {
  BlockRow blocks;
  for (PetscInt r = 0; r < block; ++r) {
    const PetscInt row = block * block_row + r;
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const double* values = nullptr;
    POUNDING_PETSC(MatGetRow(matrix, row, &count, &columns, &values));
    for (PetscInt k = 0; k < count; ++k) {
      blocks[columns[k] / block][static_cast<std::size_t>(r)]
            [static_cast<std::size_t>(columns[k] % block)] = values[k];
    }
    POUNDING_PETSC(MatRestoreRow(matrix, row, &count, &columns, &values));
  }
  return blocks;
}

/// A copy in blocks of 3, preallocated: MatConvert of 300 thousand rows takes minutes.
void copy_in_blocks(Mat matrix, const std::string& type, MatHandle& copy) {
  PetscInt begin = 0, end = 0, global_rows = 0;
  POUNDING_PETSC(MatGetOwnershipRange(matrix, &begin, &end));
  POUNDING_PETSC(MatGetSize(matrix, &global_rows, nullptr));
  const PetscInt first = begin / block, last = end / block;
  std::array<std::vector<PetscInt>, 4> counts;  // own, others' columns; the same above the diagonal
  for (PetscInt i = first; i < last; ++i) {
    for (auto& count : counts) count.push_back(0);
    for (const auto& [column, values] : read_block_row(matrix, i)) {
      const bool own = first <= column && column < last;
      ++counts[own ? 0 : 1].back();
      if (column >= i) ++counts[own ? 2 : 3].back();
    }
  }
  POUNDING_PETSC(MatCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), copy.out()));
  POUNDING_PETSC(MatSetSizes(copy.get(), end - begin, end - begin, global_rows, global_rows));
  POUNDING_PETSC(MatSetType(copy.get(), type.c_str()));
  POUNDING_PETSC(MatXAIJSetPreallocation(copy.get(), block, counts[0].data(), counts[1].data(),
                                         counts[2].data(), counts[3].data()));
  if (type == MATSBAIJ) {
    POUNDING_PETSC(MatSetOption(copy.get(), MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  }
  std::vector<PetscInt> columns;
  std::vector<double> values;
  for (PetscInt i = first; i < last; ++i) {
    const BlockRow blocks = read_block_row(matrix, i);
    columns.clear();
    for (const auto& [column, entries] : blocks) columns.push_back(column);
    values.clear();
    for (std::size_t r = 0; r < block; ++r) {
      for (const auto& [column, entries] : blocks) {
        values.insert(values.end(), entries[r].begin(), entries[r].end());
      }
    }
    POUNDING_PETSC(MatSetValuesBlocked(copy.get(), 1, &i, static_cast<PetscInt>(columns.size()),
                                       columns.data(), values.data(), INSERT_VALUES));
  }
  POUNDING_PETSC(MatAssemblyBegin(copy.get(), MAT_FINAL_ASSEMBLY));
  POUNDING_PETSC(MatAssemblyEnd(copy.get(), MAT_FINAL_ASSEMBLY));
}

/// The displacement update and w = u + beta v in one sweep, the product, the velocity update.
class MatrixStep final : public TimedStep {
 public:
  MatrixStep(const SteppedModel& model, const std::string& type)
      : system_(model.systems.at(0)),
        motion_(*model.motion),
        time_step_(model.time_step),
        matrix_(system_.stiffness->matrix()),
        displacement_(system_.lumped_mass.size(), 0.0),
        velocity_(displacement_),
        argument_(displacement_),
        force_(displacement_),
        argument_vector_(wrap_vector(system_, argument_)),
        force_vector_(wrap_vector(system_, force_)) {
    if (model.systems.size() != 1 || matrix_ == nullptr) {
      throw std::invalid_argument("a matrix step needs one structure with an assembled matrix");
    }
    if (type != MATAIJ) {
      copy_in_blocks(matrix_, type, blocked_);
      matrix_ = blocked_.get();
    }
  }

  void run(long steps) override {
    for (long i = 0; i < steps; ++i, ++step_) {
      prepare_argument(step_ > 0 ? time_step_ : 0);
      POUNDING_PETSC(MatMult(matrix_, argument_vector_.get(), force_vector_.get()));
      update_velocity(step_ > 0 ? time_step_ : time_step_ / 2);
    }
  }

  double displacement_square() const override {
    double sum = 0;
    for (const double u : displacement_) {
      sum += u * u;
    }
    return sum;
  }

 private:
  void prepare_argument(double duration) {
    const double beta = system_.damping.beta;
    const double* const v = velocity_.data();
    double* const u = displacement_.data();
    double* const w = argument_.data();
    const std::size_t n = displacement_.size();
    for (std::size_t i = 0; i < n; ++i) {
      u[i] += duration * v[i];
      w[i] = u[i] + beta * v[i];
    }
  }

  void update_velocity(double duration) {
    Vector3 acceleration{};
    motion_.evaluate(static_cast<double>(step_) * time_step_, acceleration);
    const double decay = 1 - duration * system_.damping.alpha;
    std::array<double, 4> ground_step{};  // of rotations none, then by direction
    for (std::size_t d = 0; d < 3; ++d) ground_step[1 + d] = duration * acceleration[d];
    const std::int8_t* const direction = system_.direction.data();
    const double* const inverse_mass = system_.inverse_mass.data();
    const double* const q = force_.data();
    double* const v = velocity_.data();
    const std::size_t n = velocity_.size();
    for (std::size_t i = 0; i < n; ++i) {
      v[i] = decay * v[i] - duration * (inverse_mass[i] * q[i]) -
             ground_step[static_cast<std::size_t>(1 + direction[i])];
    }
  }

  const LinearSystem& system_;
  const GroundMotion& motion_;
  double time_step_;
  Mat matrix_;  ///< the model's, or blocked_
  MatHandle blocked_;
  std::vector<double> displacement_;
  std::vector<double> velocity_;
  std::vector<double> argument_;
  std::vector<double> force_;
  VecHandle argument_vector_;
  VecHandle force_vector_;
  long step_ = 0;
};

}  // namespace

std::unique_ptr<TimedStep> make_matrix_step(const SteppedModel& model, const std::string& type) {
  return std::make_unique<MatrixStep>(model, type);
}

}  // namespace pounding::measuring
