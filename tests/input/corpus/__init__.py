"""Broken inputs by class: every module lists its cases; `case.py` says what one is."""
