import type { Page } from '../page';

function Render() {
  return <div class="page" />;
}

export const page: Page = {
  id: 'render',
  title: 'Render',
  summary: 'A scene, progressive; two and more renders side by side at equal time.',
  component: Render,
};
