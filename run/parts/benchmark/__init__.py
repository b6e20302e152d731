"""Measures steps and machine in turns, and sets the figures side by side."""
