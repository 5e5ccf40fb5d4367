"""The example of every public function runs."""

import doctest
import inspect

import pytest
import trigon3d


def documented():
    yield "trigon3d", trigon3d
    for name in trigon3d.__all__:
        item = getattr(trigon3d, name)
        yield name, item
        if inspect.isclass(item):
            for member, function in vars(item).items():
                # The table in the class's own documentation says what its arrays are.
                if not member.startswith("_") and not (item is trigon3d.Frame and not callable(function)):
                    yield f"{name}.{member}", getattr(item, member)


@pytest.mark.parametrize(("name", "item"), list(documented()))
def test_examples_of_documentation_run(name, item):
    text = inspect.getdoc(item)
    assert text, f"{name} is not documented"
    test = doctest.DocTestParser().get_doctest(text, {}, name, None, None)
    results = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test)
    assert results.failed == 0, name


def test_stubs_name_what_there_is():
    import ast
    import pathlib

    stubs = ast.parse(pathlib.Path(trigon3d.__file__).with_suffix(".pyi").read_text())
    classes = {node.name: node for node in stubs.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in stubs.body if isinstance(node, ast.FunctionDef)}
    assert set(classes) | functions == set(trigon3d.__all__)
    for name in ["Camera", "Frame", "Scene"]:
        told = {node.name for node in classes[name].body if isinstance(node, ast.FunctionDef)} - {"__init__"}
        there = {member for member in vars(getattr(trigon3d, name)) if not member.startswith("_")}
        assert told == there, name


def test_the_version_is_that_of_the_wheel():
    from importlib.metadata import version

    assert version("trigon3d") == trigon3d.__version__
