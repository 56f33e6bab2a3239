"""Machine-checked verdicts on a paper about an oscillator that bounces on a vibrating table."""

__version__ = "0.1.0"
