"""How documents are laid out: the same document, what fits on a line in one."""

import json

from hypothesis import given
from hypothesis import strategies as st

from proofs.trusted.files import digest, render

TEXTS = st.text(alphabet='ab"\\ \né{[,', max_size=60)
DOCUMENTS = st.recursive(
    st.none() | st.booleans() | TEXTS | st.integers().map(str),
    lambda inner: st.lists(inner) | st.dictionaries(TEXTS, inner),
    max_leaves=40,
)


@given(st.dictionaries(TEXTS, DOCUMENTS))
def test_what_is_laid_out_is_the_same_document(document):
    written = render(document)
    assert json.loads(written) == document
    assert render(json.loads(written)) == written
    assert digest(written) == digest(json.dumps(document))


def test_what_fits_on_a_line_is_on_one():
    numbers = [str(n) for n in range(200)]
    written = render({"short": ["1", "2"], "long": numbers, "tree": [numbers[:9], [numbers]]})
    assert '\n "short": ["1", "2"],\n' in written
    assert max(map(len, written.splitlines())) <= 100
    assert len(written.splitlines()) < 60
