"""The parts of run/plant: which runs, and what is told of them."""
