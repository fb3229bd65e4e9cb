"""The simulated cell: MuJoCo behind the ports. It knows no task; a task composes its own cell of what is here."""
