#pragma once

#include <memory>
#include <utility>

#include "interactions/laws/link_law.h"

namespace pounding::interactions {

/// Law of a link whose tangent k is part of K already, as in a structure reduced to the modes that
/// it has with every link at its stiffest: the pull of the link itself, less k e_n, so that both
/// together are the link. Its energy likewise, less 1/2 k e_n e_{n+1}: it is negative where K
/// counts more than the link holds.
class RelievingLaw final : public LinkLaw {
 public:
  explicit RelievingLaw(std::unique_ptr<LinkLaw> link) : link_(std::move(link)) {}

  double force(double before, double now, double after,
               std::span<const double> memory = {}) const override {
    return link_->force(before, now, after, memory) - link_->tangent() * now;
  }
  double solve(double before, double now, double free_after, double compliance,
               std::span<const double> memory = {}) const override {
    const double counted = link_->tangent() * now;
    return link_->solve(before, now, free_after + compliance * counted, compliance, memory) -
           counted;
  }
  double energy(double now, double after, std::span<const double> memory = {}) const override {
    return link_->energy(now, after, memory) - link_->tangent() * now * after / 2;
  }
  double tangent() const override { return 0; }
  bool is_explicit() const override { return link_->is_explicit(); }
  void rest(double now, std::span<double> memory) const override { link_->rest(now, memory); }
  double slack(std::span<const double> memory) const override { return link_->slack(memory); }
  double counted(double now) const override { return link_->tangent() * now; }
  bool has_yielded(std::span<const double> memory) const override {
    return link_->has_yielded(memory);
  }
  bool loses_plastic_work() const override { return link_->loses_plastic_work(); }
  double ductility(std::span<const double> memory) const override {
    return link_->ductility(memory);
  }
  double lost(std::span<const double> memory) const override { return link_->lost(memory); }
  bool is_idle(double /*now*/, std::span<const double> /*memory*/ = {}) const override {
    return false;
  }
  double trial(double now, std::span<const double> memory) const override {
    return link_->trial(now, memory);
  }
  double capacity() const override { return link_->capacity(); }
  void press(double force, std::span<double> memory) const override { link_->press(force, memory); }
  bool was_overpressed(std::span<const double> memory) const override {
    return link_->was_overpressed(memory);
  }
  double given(double before, double now, std::span<const double> memory) const override {
    return link_->given(before, now, memory);
  }
  void yield(double now, double kept, std::span<double> memory) const override {
    link_->yield(now, kept, memory);
  }
  std::size_t memory_size() const override { return link_->memory_size(); }
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override {
    link_->remember(before, now, after, share, memory);
  }

 private:
  std::unique_ptr<LinkLaw> link_;
};

}  // namespace pounding::interactions
