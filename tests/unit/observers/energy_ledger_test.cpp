#include "observers/energy_ledger.h"

#include <gtest/gtest.h>

namespace pounding {
namespace energy_ledger_test {

EnergyLine line_at(int number) {
  return {static_cast<double>(number), 1, 2, 8, {3, 4, 5}};
}

TEST(EnergyLedger, ThinsALongRunOut) {
  EnergyLedger ledger(20000);
  for (int i = 0; i < 20000; ++i) {
    ledger.add(line_at(i));
  }
  ASSERT_EQ(ledger.lines().size(), 5000u);
  EXPECT_EQ(ledger.lines()[0].time, 0);
  EXPECT_EQ(ledger.lines()[1].time, 4);
  EXPECT_EQ(ledger.last().time, 19999);
}

TEST(EnergyLedger, GoesOnAfterARestart) {
  constexpr int expected = 12000;
  EnergyLedger whole(expected);
  EnergyLedger before(expected);
  for (int i = 0; i < 7000; ++i) {
    whole.add(line_at(i));
    before.add(line_at(i));
  }
  SavedState saved;
  before.keep(StateKeeper::to(saved));
  EnergyLedger after(expected);
  after.keep(StateKeeper::from(saved));
  EXPECT_EQ(after.last().time, 6999);
  EXPECT_EQ(after.last().residual, 8);
  for (int i = 7000; i < expected; ++i) {
    whole.add(line_at(i));
    after.add(line_at(i));
  }
  ASSERT_EQ(after.lines().size(), whole.lines().size());
  for (std::size_t i = 0; i < whole.lines().size(); ++i) {
    EXPECT_EQ(after.lines()[i].time, whole.lines()[i].time);
  }
}

}  // namespace energy_ledger_test
}  // namespace pounding
