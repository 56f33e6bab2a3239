"""Machine-checked verdicts on a paper about an oscillator that bounces on a vibrating table."""
