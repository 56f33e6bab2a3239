"""Speed and accuracy, shown: measured here and now, beside what others would use.

Ours and theirs are timed in pairs, A B A B ..., in one run, so that a busy machine slows both. What
is compared with is optional: what is not installed is reported as absent.
"""
