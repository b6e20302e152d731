#pragma once

namespace pounding::interactions {

/// Sums of interactions on one structure that a step leaves for the energy ledger, those of this
/// rank.
struct LedgerPart {
  double link_energy_before = 0;     ///< held between u_{n-1} and u_n [J]
  double link_loss = 0;              ///< taken in the step and not kept [J]
  double link_loss_before = 0;       ///< the same of the step before, of gathered rows [J]
  double damping_loss = 0;           ///< beside that of K, by beta of elements that yield [J]
  double plastic_loss = 0;           ///< taken in the step by yielding, damage and crushing [J]
  double plastic_loss_before = 0;    ///< the same of the step before, of gathered rows [J]
  double link_input = 0;             ///< work of a wave from below [J]
  double support_input = 0;          ///< work of supports' motion and loads, contacts apart [J]
  double contact_support_input = 0;  ///< of supports against contact impulses [J]
  double contact_work = 0;           ///< 1/2 lambda^T L v- of normal impulses [J]
  double friction_loss = 0;          ///< -1/2 lambda_t^T L_t (v- + v+) [J]
};

}  // namespace pounding::interactions
