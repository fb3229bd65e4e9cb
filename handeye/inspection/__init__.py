"""Shows the contents of a plan: stages and times, flow, and differences from another plan."""
