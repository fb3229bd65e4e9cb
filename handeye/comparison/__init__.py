"""Two runs beside each other, step by step: what went otherwise first, where each searched, felt and corrected."""
