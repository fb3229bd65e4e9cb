"""Whole runs and statistics over them: where concrete cells, plans and referees are put together."""
