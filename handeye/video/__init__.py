"""Makes videos of recorded runs: moments, views, captions and file formats."""
