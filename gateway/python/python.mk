# The Python client with its generated module, in one folder that can be copied anywhere.
.PHONY: python
python: build/python/tactus.py build/python/tactus_pb2.py      ## write the Python client into build/python
build/python/tactus.py: gateway/python/tactus.py
	$(call say,PY    $@)
	$(Q)cp $< $@
build/python/tactus_pb2.py: gateway/tactus.proto
	$(call say,PY    $@)
	$(Q)protoc -I$(<D) --python_out=$(@D) --pyi_out=$(@D) $<
$(filter $(B)/tests/gateway/test_python%,$(TESTS)): | python
