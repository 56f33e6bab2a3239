"""Every claim of the paper: proved, or only checked where its certificate is there already."""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.ledger")

from proofs.shell import ledger

main = ledger.main
