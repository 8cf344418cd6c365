"""Every mutation of the list still applies to the code, and names tests that are there."""

from __future__ import annotations

import ast
import re
from collections import Counter

import pytest
from mutations import ROOT, Mutation, module_of_tests, read_mutations

MUTATIONS = read_mutations()


@pytest.mark.parametrize("mutation", MUTATIONS, ids=lambda mutation: mutation.id)
def test_mutation_applies(mutation: Mutation) -> None:
    path, text = mutation.applied(ROOT)
    assert ast.dump(ast.parse(text)) != ast.dump(ast.parse(path.read_bytes()))
    assert mutation.seen_by
    for name, keywords in mutation.seen_by.items():
        words = set(re.findall(r"\w+", keywords.casefold())) - {"and", "or", "not"}
        module = module_of_tests(ROOT, name).read_text("utf-8").casefold()
        assert name == "test_pages" or not {word for word in words if word not in module}


def test_every_mutation_has_a_name_of_its_own() -> None:
    names = Counter(mutation.id for mutation in MUTATIONS)
    assert [name for name, count in names.items() if count > 1] == []
