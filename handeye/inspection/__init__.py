"""Shows what a plan contains: stages and times, flow, and differences from another plan."""
