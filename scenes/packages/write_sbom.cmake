# Writes the components of raylane's binaries as SPDX 2.3 in JSON. The build runs it by cmake -P.
#
# `list`: the file with the components and the version that CMakeLists.txt writes; `binaries`: NAME=FILE...;
# `readelf`; `output`. A shared library of no known component is listed by itself.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/source_date.cmake)
include(${list})
string(TIMESTAMP created "%Y-%m-%dT%H:%M:%SZ" UTC) # from SOURCE_DATE_EPOCH

set(packages "")
set(relationships "")
function(package id name version licence location reference comment)
  set(text "    {\n      \"SPDXID\": \"SPDXRef-${id}\",\n      \"name\": \"${name}\",\n")
  if(version)
    string(APPEND text "      \"versionInfo\": \"${version}\",\n")
  endif()
  string(APPEND text "      \"supplier\": \"NOASSERTION\",\n"
         "      \"downloadLocation\": \"${location}\",\n      \"filesAnalyzed\": false,\n"
         "      \"licenseConcluded\": \"${licence}\",\n      \"licenseDeclared\": \"${licence}\",\n"
         "      \"copyrightText\": \"NOASSERTION\"")
  if(comment)
    string(APPEND text ",\n      \"comment\": \"${comment}\"")
  endif()
  if(reference)
    string(APPEND text ",\n      \"externalRefs\": [\n        { \"referenceCategory\": \"PACKAGE-MANAGER\", "
           "\"referenceType\": \"purl\", \"referenceLocator\": \"${reference}\" }\n      ]")
  endif()
  set(packages ${packages} "${text}\n    }" PARENT_SCOPE)
endfunction()
function(relationship from type to comment)
  set(relationships ${relationships}
      "    { \"spdxElementId\": \"SPDXRef-${from}\", \"relationshipType\": \"${type}\", \"relatedSpdxElement\": \"SPDXRef-${to}\", \"comment\": \"${comment}\" }"
      PARENT_SCOPE)
endfunction()

set(needed_by_any "")
foreach(binary ${binaries})
  string(REGEX MATCH "^([^=]+)=(.+)$" ignored "${binary}")
  set(name ${CMAKE_MATCH_1})
  set(file ${CMAKE_MATCH_2})
  list(APPEND names ${name})
  package(${name} ${name} ${version} MIT NOASSERTION "" "")
  relationship(DOCUMENT DESCRIBES ${name} "a binary of raylane")
  set(needed_by_${name} "")
  if(NOT file MATCHES "[.]a$")
    execute_process(COMMAND ${readelf} -dW ${file} OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "NEEDED[^\n]*" lines "${dynamic}")
    foreach(line ${lines})
      string(REGEX REPLACE ".*\\[(.*)\\].*" "\\1" library "${line}")
      list(APPEND needed_by_${name} ${library})
    endforeach()
  endif()
  list(APPEND needed_by_any ${needed_by_${name}})
endforeach()
list(REMOVE_DUPLICATES needed_by_any)
list(SORT needed_by_any)

foreach(component ${components})
  string(REPLACE "~" ";" fields "${component}")
  list(GET fields 0 id)
  list(GET fields 1 component_version)
  list(GET fields 2 licence)
  list(GET fields 3 origin)
  list(GET fields 4 pattern)
  list(GET fields 5 includers)
  string(REPLACE "," ";" includers "${includers}")
  set(libraries "")
  if(pattern)
    set(libraries ${needed_by_any})
    list(FILTER libraries INCLUDE REGEX "^${pattern}")
    list(REMOVE_ITEM needed_by_any ${libraries})
  endif()
  set(location NOASSERTION)
  if(origin MATCHES "^github/(.+)")
    set(location "https://github.com/${CMAKE_MATCH_1}")
  endif()
  set(comment "")
  if(libraries)
    list(JOIN libraries " " comment)
    string(PREPEND comment "shared libraries: ")
  endif()
  package(${id} ${id} "${component_version}" "${licence}" "${location}"
          "pkg:${origin}@${component_version}" "${comment}")
  foreach(name ${names})
    set(linked "")
    foreach(library ${libraries})
      if(library IN_LIST needed_by_${name})
        list(APPEND linked ${library})
      endif()
    endforeach()
    if(linked)
      list(JOIN linked " " linked)
      relationship(${name} DYNAMIC_LINK ${id} "${linked}")
    endif()
    if(name IN_LIST includers)
      relationship(${name} STATIC_LINK ${id} "what of its headers is compiled in")
    endif()
  endforeach()
endforeach()
foreach(library ${needed_by_any}) # libraries of a system that components.cmake does not know
  string(MAKE_C_IDENTIFIER ${library} id)
  string(REPLACE "_" "-" id ${id})
  package(${id} ${library} "" NOASSERTION NOASSERTION "" "shared libraries: ${library}")
  foreach(name ${names})
    if(library IN_LIST needed_by_${name})
      relationship(${name} DYNAMIC_LINK ${id} ${library})
    endif()
  endforeach()
endforeach()

list(JOIN packages ",\n" packages)
list(JOIN relationships ",\n" relationships)
# The name of the document is unique: it differs if the document differs.
string(UUID uuid NAMESPACE 6ba7b811-9dad-11d1-80b4-00c04fd430c8 TYPE SHA1
       NAME "raylane ${version} ${created} ${packages} ${relationships}")
set(document "{
  \"spdxVersion\": \"SPDX-2.3\",
  \"dataLicense\": \"CC0-1.0\",
  \"SPDXID\": \"SPDXRef-DOCUMENT\",
  \"name\": \"raylane-${version}\",
  \"documentNamespace\": \"urn:uuid:${uuid}\",
  \"creationInfo\": {
    \"created\": \"${created}\",
    \"creators\": [\"Tool: raylane-${version}-build\"]
  },
  \"packages\": [
${packages}
  ],
  \"relationships\": [
${relationships}
  ]
}
")
file(CONFIGURE OUTPUT ${output} CONTENT "${document}" @ONLY)
