//! Which products and sums are one operation where instructions have that.

use super::{Expr, Graph, Node};

impl Graph {
    /// The products that a single sum or difference reads and nothing else, in as many branches:
    /// one shared by branches is computed once for all.
    ///
    /// Of a sum of two products the first is fused with the sum, the second is rounded.
    pub fn fused(&self, outputs: &[Expr]) -> Vec<bool> {
        let needed = self.reachable(outputs);
        let levels = self.levels();
        let mut readers = vec![0; self.nodes.len()];
        let mut fused = vec![false; self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate().filter(|(i, _)| needed[*i]) {
            let is_sum = matches!(node, Node::Add(..) | Node::Sub(..));
            for operand in node.operands() {
                let is_product = matches!(self.node(operand), Node::Mul(..));
                let operand = operand.index();
                readers[operand] += 1;
                fused[operand] = is_sum && is_product && levels[operand] == levels[i];
            }
        }
        for output in outputs {
            fused[output.index()] = false;
        }
        let alone = fused.iter().zip(&readers);
        alone
            .map(|(fused, readers)| *fused && *readers == 1)
            .collect()
    }
}
