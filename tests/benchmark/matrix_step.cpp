#include <stdexcept>

#include "benchmark/timed_step.h"

namespace pounding::measuring {
namespace {

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
      POUNDING_PETSC(MatSetBlockSize(matrix_, 3));
      POUNDING_PETSC(MatConvert(matrix_, type.c_str(), MAT_INITIAL_MATRIX, converted_.out()));
      matrix_ = converted_.get();
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

  /// Every dof is a translation and the motion is the same in all directions: iota is 1.
  void update_velocity(double duration) {
    Vector3 acceleration{};
    motion_.evaluate(static_cast<double>(step_) * time_step_, acceleration);
    const double decay = 1 - duration * system_.damping.alpha;
    const double ground_step = duration * acceleration[0];
    const double* const inverse_mass = system_.inverse_mass.data();
    const double* const q = force_.data();
    double* const v = velocity_.data();
    const std::size_t n = velocity_.size();
    for (std::size_t i = 0; i < n; ++i) {
      v[i] = decay * v[i] - duration * (inverse_mass[i] * q[i]) - ground_step;
    }
  }

  const LinearSystem& system_;
  const GroundMotion& motion_;
  double time_step_;
  Mat matrix_;  ///< the model's, or converted_
  MatHandle converted_;
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
