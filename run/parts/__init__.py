"""The parts of the commands beside: one package per command."""
