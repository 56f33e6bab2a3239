"""The independent checker: standard library, own arithmetic, the shared statements and equations.

It re-derives every conclusion of a certificate from its witnesses and believes nothing in it.
"""
