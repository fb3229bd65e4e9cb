"""The two waists of the system, program and plan, and the planner that leads from one to the other."""
