"""`python -m proofs`: every claim decided so far, with one exit status."""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.__main__")

from proofs.shell import ledger

main = ledger.main
