"""An attribute of BrittleFEMat that refuses a value."""
import pytest

from yade import wrapper as w


def assertRefused(attribute, given, kind, message):
    """An error of this kind with this message, by assignment and by constructor; the value stays the default."""
    material = w.BrittleFEMat()
    former = getattr(material, attribute)
    with pytest.raises(kind) as refused:
        setattr(material, attribute, given)
    assert message in str(refused.value)
    with pytest.raises(kind):
        w.BrittleFEMat(**{attribute: given})
    assert getattr(material, attribute) == former == getattr(w.BrittleFEMat(), attribute)
