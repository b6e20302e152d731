"""Parts of run/soil: a table of impedances, the soil fitted to it, the file that the program reads."""
