"""The headline theorem in Coq: the theory, and the writer of a certificate's cases."""
