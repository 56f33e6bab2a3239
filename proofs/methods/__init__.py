"""Methods of proof for any map: they are given f(box) and f'(box), and see no oscillator."""
