"""Tasks: each a folder with a scene, its errors, its referee and what else knows it."""
