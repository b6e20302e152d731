#pragma once

#include "common/petsc.h"

/// Named events of -log_view.
namespace pounding {

/// An event; the same name is the same event.
class LogEvent {
 public:
  explicit LogEvent(const char* name) {
    POUNDING_PETSC(PetscLogEventRegister(name, PETSC_OBJECT_CLASSID, &event_));
  }
  PetscLogEvent get() const { return event_; }

 private:
  PetscLogEvent event_ = 0;
};

/// Charges its lifetime to an event; nothing unless PETSc logs.
class ScopedEvent {
 public:
  explicit ScopedEvent(const LogEvent& event) : event_(event.get()) {
    POUNDING_PETSC(PetscLogEventBegin(event_, 0, 0, 0, 0));
  }
  ScopedEvent(const ScopedEvent&) = delete;
  ScopedEvent& operator=(const ScopedEvent&) = delete;
  ~ScopedEvent() { static_cast<void>(PetscLogEventEnd(event_, 0, 0, 0, 0)); }

 private:
  PetscLogEvent event_;
};

}  // namespace pounding
