#include "signweave/xpath/evaluate.h"

#include <fmt/format.h>
#include <libxml/parser.h>
#include <libxml/xpath.h>
#include <libxml/xpathInternals.h>

#include <atomic>
#include <condition_variable>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <thread>

#include "signweave/xpath/tokens.h"
#include "signweave/xpath/tree.h"

namespace signweave::xpath {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // limit of one document's answers

template <auto free>
struct Free {
  template <class T>
  void operator()(T* one) const noexcept {
    free(one);
  }
};
using Context = std::unique_ptr<xmlXPathContext, Free<xmlXPathFreeContext>>;
using Compiled = std::unique_ptr<xmlXPathCompExpr, Free<xmlXPathFreeCompExpr>>;
using Object = std::unique_ptr<xmlXPathObject, Free<xmlXPathFreeObject>>;
using Buffer = std::unique_ptr<xmlBuffer, Free<xmlBufferFree>>;

/// The first error that libxml2 reported.
struct Fault {
  int code = 0;  ///< an xmlXPathError
  std::size_t offset = 0;
};

extern "C" void note_fault(void* to, xmlErrorPtr error) {
  Fault& fault = *static_cast<Fault*>(to);
  if (fault.code != 0) return;
  const bool of_xpath = error->domain == XML_FROM_XPATH;
  fault.code = of_xpath ? error->code - XML_XPATH_EXPRESSION_OK : -1;
  if (error->int1 > 0) fault.offset = static_cast<std::size_t>(error->int1);
  if (error->code == XML_ERR_NO_MEMORY) fault.code = XPATH_MEMORY_ERROR;
}

std::string words_for(int code) {
  switch (code) {
    case XPATH_NUMBER_ERROR:
      return "expected a number";
    case XPATH_EXPR_ERROR:
      return "expected a path or a value here, such as //ANNOTATION_VALUE or 'text'";
    case XPATH_INVALID_PREDICATE_ERROR:
      return "expected the end of the predicate, ']'";
    case XPATH_UNCLOSED_ERROR:
      return "a bracket is not closed; add it";
    case XPATH_INVALID_TYPE:
      return "a value of this kind is not allowed here: the operand of count(), sum(), '|' or a path must be "
             "nodes";
    case XPATH_INVALID_OPERAND:
      return "an operand is missing or of the wrong kind; correct it";
    case XPATH_INVALID_ARITY:
      return "a function has too many or too few arguments; correct their number";
    case XPATH_UNDEF_PREFIX_ERROR:
      return "a prefix without a namespace; only 'xsi' and 'xml' have one here";
    case XPATH_RECURSION_LIMIT_EXCEEDED:
      return "the expression is nested too deeply; simplify it";
    case XPATH_STACK_ERROR:
      return "the expression is incomplete; add the missing part";
    default:
      return "this is not an XPath 1.0 expression";
  }
}

[[noreturn]] void refuse(const std::string& text, const Fault& fault) {
  if (fault.code == XPATH_MEMORY_ERROR) throw std::bad_alloc();
  fail(text, fault.offset, words_for(fault.code));
}

void initialise() {
  static std::once_flag once;
  std::call_once(once, xmlInitParser);
}

Context context_for(xmlDoc* tree, Fault& fault) {
  initialise();
  Context context(xmlXPathNewContext(tree));
  if (!context) throw std::bad_alloc();
  context->error = note_fault;
  context->userData = &fault;
  xmlXPathRegisterNs(context.get(), chars("xsi"), chars(kSchemaInstance));
  return context;
}

Compiled compile(const std::string& text, xmlXPathContext* context, Fault& fault) {
  Compiled compiled(xmlXPathCtxtCompile(context, chars(text.c_str())));
  if (!compiled || fault.code != 0) refuse(text, fault);
  return compiled;
}

/// Stops an evaluation at its deadline: libxml2 checks its limit of operations at every step, and this lowers the
/// limit. The word is aligned and written atomically; a step that reads the old value is followed by one that stops.
class DeadlineGuard {
 public:
  DeadlineGuard(xmlXPathContext& context, std::optional<std::chrono::steady_clock::time_point> deadline) {
    context.opLimit = std::numeric_limits<unsigned long>::max();
    if (!deadline) return;
    thread_ = std::thread([this, &context, at = *deadline] {
      std::unique_lock lock(mutex_);
      if (ended_.wait_until(lock, at, [this] { return over_; })) return;
      std::atomic_ref(context.opLimit).store(1, std::memory_order_relaxed);
    });
  }
  ~DeadlineGuard() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    ended_.notify_all();
    if (thread_.joinable()) thread_.join();
  }
  DeadlineGuard(const DeadlineGuard&) = delete;
  DeadlineGuard& operator=(const DeadlineGuard&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool over_ = false;
  std::thread thread_;
};

std::string taken(xmlChar* text) {
  if (text == nullptr) throw std::bad_alloc();
  std::string copy(reinterpret_cast<const char*>(text));
  xmlFree(text);
  return copy;
}

std::string qualified(const xmlNs* name_space, const xmlChar* name) {
  std::string whole;
  if (name_space != nullptr && name_space->prefix != nullptr) {
    whole = std::string(reinterpret_cast<const char*>(name_space->prefix)) + ':';
  }
  return whole + reinterpret_cast<const char*>(name);
}

std::string xml_of(xmlNode* node) {
  const Buffer buffer(xmlBufferCreate());
  if (!buffer) throw std::bad_alloc();
  xmlBufferSetAllocationScheme(buffer.get(), XML_BUFFER_ALLOC_DOUBLEIT);
  if (node->type == XML_DOCUMENT_NODE) {
    for (xmlNode* child = node->children; child != nullptr; child = child->next) {
      xmlNodeDump(buffer.get(), node->doc, child, 0, 0);
    }
  } else {
    xmlNodeDump(buffer.get(), node->doc, node, 0, 0);
  }
  const xmlChar* content = xmlBufferContent(buffer.get());
  std::string text(content == nullptr ? "" : reinterpret_cast<const char*>(content));
  if (node->type == XML_ATTRIBUTE_NODE && text.starts_with(' ')) text.erase(0, 1);
  return text;
}

Value value_of(xmlNode* node) {
  Value value;
  value.value = taken(xmlXPathCastNodeToString(node));
  if (node->type == XML_NAMESPACE_DECL) {
    const auto* declared = reinterpret_cast<const xmlNs*>(node);
    value.kind = Value::Kind::name_space;
    if (declared->prefix != nullptr) value.name = reinterpret_cast<const char*>(declared->prefix);
    value.xml = fmt::format("xmlns{}{}=\"{}\"", value.name.empty() ? "" : ":", value.name, value.value);
    return value;
  }
  value.xml = xml_of(node);
  switch (node->type) {
    case XML_ELEMENT_NODE:
      value.kind = Value::Kind::element;
      value.name = qualified(node->ns, node->name);
      break;
    case XML_ATTRIBUTE_NODE:
      value.kind = Value::Kind::attribute;
      value.name = qualified(node->ns, node->name);
      break;
    case XML_COMMENT_NODE:
      value.kind = Value::Kind::comment;
      break;
    case XML_PI_NODE:
      value.kind = Value::Kind::instruction;
      break;
    case XML_DOCUMENT_NODE:
      value.kind = Value::Kind::document;
      break;
    default:
      value.kind = Value::Kind::text;
  }
  return value;
}

std::vector<Value> values_of(xmlXPathObject& object, const EvaluateLimits& limits) {
  std::vector<Value> values;
  const std::size_t most = limits.limit.value_or(std::numeric_limits<std::size_t>::max());
  if (object.type == XPATH_NODESET) {
    if (object.nodesetval == nullptr) return values;
    xmlXPathNodeSetSort(object.nodesetval);
    std::size_t bytes = 0;
    for (int i = 0; i < object.nodesetval->nodeNr && values.size() < most; ++i) {
      values.push_back(value_of(object.nodesetval->nodeTab[i]));
      bytes += values.back().value.size() + values.back().xml.size();
      if (bytes > kMostBytes) {
        throw Error(ErrorCode::unsupported,
                    "xpath: the answers of one document exceed 256 MiB; request less, "
                    "such as their count()");
      }
      if (limits.deadline && i % 64 == 0 && std::chrono::steady_clock::now() >= *limits.deadline) {
        throw Error(ErrorCode::cancelled, "xpath: took longer than allowed; request less or allow more time");
      }
    }
    return values;
  }
  if (most == 0) return values;
  Value value;
  value.kind = object.type == XPATH_BOOLEAN  ? Value::Kind::boolean
               : object.type == XPATH_NUMBER ? Value::Kind::number
                                             : Value::Kind::string;
  value.value = taken(xmlXPathCastToString(&object));
  value.xml = value.value;
  return {std::move(value)};
}

}  // namespace

void compile_to_check(const std::string& expression) {
  Fault fault;
  const Context context = context_for(nullptr, fault);
  compile(expression, context.get(), fault);
}

std::vector<Value> evaluate(const Expression& expression, const std::string& name, std::string_view document,
                            const EvaluateLimits& limits) {
  const auto over = [&] { return limits.deadline && std::chrono::steady_clock::now() >= *limits.deadline; };
  const auto cancel = [] {
    throw Error(ErrorCode::cancelled, "xpath: took longer than allowed; request less or allow more time");
  };
  const auto alive = [&] {
    if (over()) cancel();
  };
  alive();
  const eaf::Xml xml(name, document, "an annotation file");
  const Tree tree = tree_of(xml, alive);
  xmlXPathOrderDocElems(tree.get());
  Fault fault;
  const Context context = context_for(tree.get(), fault);
  context->node = reinterpret_cast<xmlNode*>(tree.get());
  const Compiled compiled = compile(expression.text(), context.get(), fault);
  Object object;
  {
    const DeadlineGuard deadline_guard(*context, limits.deadline);
    object.reset(xmlXPathCompiledEval(compiled.get(), context.get()));
  }
  if (fault.code == XPATH_OP_LIMIT_EXCEEDED || over()) cancel();
  if (!object || fault.code != 0) refuse(expression.text(), fault);
  return values_of(*object, limits);
}

}  // namespace signweave::xpath
