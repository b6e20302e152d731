#include "observers/observer.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pounding {
namespace observer_test {

using testing::ElementsAre;

/// Notes the calls that it gets.
class Noting final : public Observer {
 public:
  Noting(std::vector<std::string>& calls, std::string name, std::int64_t stride, StepNeeds needs,
         bool follows = false)
      : calls_(calls), name_(std::move(name)), stride_(stride), needs_(needs), follows_(follows) {}

  void start(const CdLagrange& /*stepper*/, const SavedState* continued) override {
    note(continued != nullptr ? "continues" : "starts");
  }
  std::int64_t next_due(std::int64_t step) const override { return next_multiple(step, stride_); }
  StepNeeds begin(const CdLagrange& /*stepper*/) override {
    note("begins");
    return needs_;
  }
  void observe(const CdLagrange& /*stepper*/) override { note("observes"); }
  bool follows() const override { return follows_; }
  void follow(const CdLagrange& /*stepper*/) override { note("follows"); }

 private:
  void note(const char* call) { calls_.push_back(name_ + " " + call); }

  std::vector<std::string>& calls_;
  std::string name_;
  std::int64_t stride_;
  StepNeeds needs_;
  bool follows_;
};

class ObserverList : public testing::Test {
 protected:
  /// The calls of a step, its needs in `needs`.
  std::vector<std::string> step() {
    calls_.clear();
    needs_ = observers_.before(stepper_);
    calls_.emplace_back("step");
    stepper_.step(false, false);
    observers_.after(stepper_);
    return calls_;
  }

  GroundMotion still_{{}, Resampling::linear};
  Profile profile_;
  CdLagrange stepper_{MPI_COMM_SELF, {}, still_, 1e-3, profile_};
  std::vector<std::string> calls_;
  Observers observers_{profile_};
  StepNeeds needs_;
};

TEST_F(ObserverList, CallsInOrderThoseThatAreDueAndAsksTheStepForAllOfTheirNeeds) {
  observers_.add(std::make_unique<Noting>(calls_, "gaps", 2, StepNeeds{.gaps = true}));
  observers_.add(std::make_unique<Noting>(calls_, "sum", Observer::never / 2, StepNeeds{}, true));
  observers_.add(std::make_unique<Noting>(calls_, "ledger", 3, StepNeeds{.energies = true}));
  observers_.start(stepper_, nullptr);
  EXPECT_THAT(calls_, ElementsAre("gaps starts", "sum starts", "ledger starts"));
  EXPECT_THAT(step(),
              ElementsAre("gaps begins", "sum begins", "ledger begins", "step", "sum follows",
                          "gaps observes", "sum observes", "ledger observes"));
  EXPECT_TRUE(needs_.gaps && needs_.energies && !needs_.forces);
  EXPECT_THAT(step(), ElementsAre("step", "sum follows"));
  EXPECT_FALSE(needs_.gaps || needs_.energies || needs_.forces);
  EXPECT_THAT(step(), ElementsAre("gaps begins", "step", "sum follows", "gaps observes"));
  EXPECT_TRUE(needs_.gaps && !needs_.energies);
  EXPECT_THAT(step(), ElementsAre("ledger begins", "step", "sum follows", "ledger observes"));
  EXPECT_TRUE(!needs_.gaps && needs_.energies);
}

TEST_F(ObserverList, GoesOnAtTheStepThatARunIsContinuedAt) {
  for (int n = 0; n < 3; ++n) stepper_.step(false, false);
  observers_.add(std::make_unique<Noting>(calls_, "one", 2, StepNeeds{}));
  const SavedState saved;
  observers_.start(stepper_, &saved);
  EXPECT_THAT(calls_, ElementsAre("one continues"));
  EXPECT_THAT(step(), ElementsAre("step"));  // to t_3
  EXPECT_THAT(step(), ElementsAre("one begins", "step", "one observes"));
}

}  // namespace observer_test
}  // namespace pounding
