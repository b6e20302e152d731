"""The sweeps of run/stability: scenes taken to their extremes, what is expected, what is seen."""
