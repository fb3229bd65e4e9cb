"""What kinematics and tolerances predict of a plan in many worlds, and how well that agrees with whole trials."""
