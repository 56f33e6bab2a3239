"""Section 3.3: impacts with restitution."""
