"""Reports on runs: reads traces and results, and executes nothing."""
