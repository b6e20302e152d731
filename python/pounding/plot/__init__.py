"""Figures and report of a result folder; run/plot is the command."""
