"""The impact oscillator: its equations, and rigorous enclosures of its impact map."""
