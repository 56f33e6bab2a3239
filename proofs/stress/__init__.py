"""Try to break the arithmetic and the map where they are weakest, judged by another kernel.

Hard arguments and hard launches, at random. An answer may be wide, may cost many digits, may be
refused; it may never exclude the truth, which a 100-digit computation by python-flint's Arb knows
that shares no code with what is tried.
"""
