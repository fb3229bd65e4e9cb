"""Shows what is in a plan: stages and times, flow, and differences from another plan."""
