"""Videos of recorded runs: which moments, from where, with which words, and as which file."""
