# The Python client with its generated module, in one folder that can be copied anywhere. pip takes gateway/python itself (setup.py).
CLIENT := $(wildcard gateway/python/tactus/*.py) gateway/python/tactus/py.typed
.PHONY: python
python: $(CLIENT:gateway/%=build/%) build/python/tactus/tactus_pb2.py      ## write the Python client into build/python
build/python/tactus/%: gateway/python/tactus/%
	$(call say,PY    $@)
	$(Q)install -D -m 644 $< $@
build/python/tactus/tactus_pb2.py: gateway/tactus.proto
	$(call say,PY    $@)
	$(Q)mkdir -p $(@D)
	$(Q)protoc -I$(<D) --python_out=$(@D) --pyi_out=$(@D) $<
$(filter $(B)/tests/gateway/python/test_%,$(TESTS)): | python
