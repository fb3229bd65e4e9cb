"""Facts about a run for display: pictures, forces, planned and measured places, and outcome."""
