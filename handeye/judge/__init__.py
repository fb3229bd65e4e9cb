"""The referee: measures the finished pump from the simulator's truth, and tells only the report."""
